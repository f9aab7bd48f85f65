-- Tests Neovim with the settings of editors/nvim/README.md for Neovim without the plugin.
--
-- Run by scripts/editors-try.sh in a Neovim with these settings, in the folder of the sources.
-- PARTC_TRY_FOLDER is a folder that it may write to.
local folder = vim.env.PARTC_TRY_FOLDER

local function fail(text)
  io.stderr:write('neovim: ' .. text .. '\n')
  vim.cmd('cquit 1')
end

local function await(what, condition)
  if not vim.wait(20000, condition, 20) then
    fail(what .. ' did not happen')
  end
end

local function equal(what, expected, found)
  if not vim.deep_equal(expected, found) then
    fail(what .. ': expected ' .. vim.inspect(expected) .. ', found ' .. vim.inspect(found))
  end
end

-- The reports of `partc check` on a file, sorted: line, column and end in characters, code.
local function reported(file)
  local result = {}
  for _, line in ipairs(vim.fn.systemlist({ 'partc', 'check', '--format', 'json', file })) do
    local report = vim.fn.json_decode(line)
    table.insert(
      result,
      string.format(
        '%d:%d-%d:%d %s',
        report.start.line,
        report.start.column,
        report['end'].line,
        report['end'].column,
        report.code
      )
    )
  end
  table.sort(result)
  return result
end

-- The diagnostics of the current buffer in the same form. Neovim counts bytes.
local function shown()
  local function column(line, bytes)
    local text = vim.api.nvim_buf_get_lines(0, line, line + 1, false)[1] or ''
    return vim.fn.strchars(text:sub(1, bytes)) + 1
  end
  local result = {}
  for _, d in ipairs(vim.diagnostic.get(0)) do
    local code = d.code or d.user_data.lsp.code
    table.insert(
      result,
      string.format(
        '%d:%d-%d:%d %s',
        d.lnum + 1,
        column(d.lnum, d.col),
        d.end_lnum + 1,
        column(d.end_lnum, d.end_col),
        code
      )
    )
  end
  table.sort(result)
  return result
end

local file = folder .. '/деталь.part'
vim.fn.writefile(vim.fn.readfile('test/programs/names/bad/beside-wide-letters.part', 'b'), file, 'b')
vim.cmd('edit ' .. vim.fn.fnameescape(file))
equal('file type', 'part', vim.bo.filetype)
await('a diagnostic', function()
  return #vim.diagnostic.get(0) > 0
end)
equal('diagnostics', reported(file), shown())

vim.cmd([[%s/ лишнее//]])
vim.cmd([[%s/неизвестно/длина/]])
await('the end of the diagnostics', function()
  return #vim.diagnostic.get(0) == 0
end)
vim.cmd('write')
equal('partc check of the corrected program', {}, reported(file))

vim.fn.cursor(vim.fn.line('$'), 1)
vim.fn.search('длина')
local hover = vim.lsp.buf_request_sync(0, 'textDocument/hover', vim.lsp.util.make_position_params(), 20000)
equal('hover', true, vim.inspect(hover):find('длина = 41 mm', 1, true) ~= nil)
vim.lsp.buf.definition()
await('the jump to the definition', function()
  return vim.fn.line('.') == 7
end)

-- A misspelt name is mended by its fix.
vim.cmd([[%s/(длина, длина)/(длина, длинна)/]])
await('the diagnostic of the misspelt name', function()
  return #vim.diagnostic.get(0) == 1
end)
local at = vim.diagnostic.get(0)[1]
vim.fn.cursor(at.lnum + 1, at.col + 1)
vim.ui.select = function(items, _, choose)
  choose(items[1], 1)
end
vim.lsp.buf.code_action()
await('the end of the misspelt name', function()
  return vim.fn.search('длинна', 'nw') == 0 and #vim.diagnostic.get(0) == 0
end)

-- The name is completed after its first letters.
vim.cmd([[%s/(длина, длина)/(длина, дли)/]])
vim.fn.search('дли)')
vim.fn.cursor(vim.fn.line('.'), vim.fn.col('.') + #'дли')
local answer = vim.lsp.buf_request_sync(0, 'textDocument/completion', vim.lsp.util.make_position_params(), 20000)
local offered = {}
for _, one in pairs(answer) do
  for _, item in ipairs(vim.lsp.util.extract_completion_items(one.result)) do
    offered[item.label] = item
  end
end
equal('completion', true, offered['длина'] ~= nil)
vim.lsp.util.apply_text_edits({ offered['длина'].textEdit }, 0, 'utf-16')
equal('text after completion', 'let c = (длина, длина)', vim.fn.getline('.'))

-- The name is changed everywhere.
vim.fn.cursor(7, 5)
vim.lsp.buf.rename('length_of_part')
await('the change of the name', function()
  return vim.fn.search('длина', 'nw') == 0
end)
vim.cmd('write')
equal('partc check after the change of the name', {}, reported(file))

vim.lsp.buf.formatting_sync({}, 20000)
vim.cmd('write')
equal('partc fmt --check', '', vim.fn.system({ 'partc', 'fmt', '--check', file }))

-- A second file uses the same server.
vim.cmd('edit ' .. vim.fn.fnameescape(folder .. '/new.part'))
equal('number of servers', 1, #vim.lsp.get_active_clients())

local version = vim.version()
print(string.format('neovim: %d.%d.%d without the plugin\n', version.major, version.minor, version.patch))
vim.cmd('qall!')
