-- Starts `partc lsp` once and attaches every part program to it. For Neovim 0.7.2 and later.
local M = {}

-- The running server, where Neovim does not keep count itself (before 0.8).
local client = nil

local function prepare(_, buffer)
  vim.bo[buffer].tagfunc = 'v:lua.vim.lsp.tagfunc'
  vim.keymap.set('n', 'K', vim.lsp.buf.hover, { buffer = buffer, desc = 'What is this?' })
  vim.keymap.set('n', 'gd', vim.lsp.buf.definition, { buffer = buffer, desc = 'Where is this defined?' })
end

function M.attach(buffer)
  -- let g:partc_command = ['/path/to/partc', 'lsp'] when partc is not on the path.
  local command = vim.g.partc_command or { 'partc', 'lsp' }
  if vim.bo[buffer].buftype ~= '' then
    return
  end
  if vim.fn.executable(command[1]) == 0 then
    vim.notify('partc: ' .. command[1] .. ' is not on the path', vim.log.levels.WARN)
    return
  end
  local config = { name = 'partc', cmd = command, root_dir = vim.fn.getcwd(), on_attach = prepare }
  if vim.lsp.start then
    vim.lsp.start(config, { bufnr = buffer })
    return
  end
  if not client then
    config.on_exit = function()
      client = nil
    end
    client = vim.lsp.start_client(config)
  end
  if client then
    vim.lsp.buf_attach_client(buffer, client)
  end
end

return M
