-- Run in a real Neovim with a program open: writes what the editor shows, as JSON, to $PARTC_TEST_ANSWER.
-- Every wait has an end, so a silent server gives an answer with little in it.
local patience = tonumber(vim.env.PARTC_TEST_PATIENCE)
local answer = { diagnostics = {}, jumped = false, fixed = false, hover = '' }

local function await(condition)
  return vim.wait(patience, condition, 20)
end

-- The column behind the n-th occurrence of a word on a line, in bytes.
local function find(line, word)
  local text = vim.api.nvim_buf_get_lines(0, line - 1, line, true)[1]
  return text:find(word, 1, true) - 1
end

answer.filetype = vim.bo.filetype

if not await(function()
  return #vim.diagnostic.get(0) > 0
end) then
  -- Nothing will come any more.
  patience = 100
end
for _, d in ipairs(vim.diagnostic.get(0)) do
  local code = d.code or (d.user_data and d.user_data.lsp and d.user_data.lsp.code)
  table.insert(answer.diagnostics, {
    from = { d.lnum, d.col },
    to = { d.end_lnum, d.end_col },
    code = code,
    severity = d.severity,
  })
end

-- From the use on the last line to the definition.
local last = vim.api.nvim_buf_line_count(0)
vim.api.nvim_win_set_cursor(0, { last, find(last, 'длина') })
vim.lsp.buf.definition()
answer.jumped = await(function()
  return vim.api.nvim_win_get_cursor(0)[1] ~= last
end)
answer.cursor = vim.api.nvim_win_get_cursor(0)

local results = vim.lsp.buf_request_sync(0, 'textDocument/hover', vim.lsp.util.make_position_params(), patience)
for _, r in pairs(results or {}) do
  if r.result then
    answer.hover = r.result.contents.value
  end
end

-- Words are put into the text one by one, as a person types, until nothing is wrong with it.
local wrong = vim.fn.search('лишнее') - 1
local column = find(wrong + 1, 'лишнее')
vim.api.nvim_buf_set_text(0, wrong, column, wrong, column + #'лишнее', { '-- 🙂' })
local unknown = vim.fn.search('неизвестно') - 1
column = find(unknown + 1, 'неизвестно')
vim.api.nvim_buf_set_text(0, unknown, column, unknown, column + #'неизвестно', { '' })
for i, letter in ipairs({ 'д', 'л', 'и', 'н', 'а' }) do
  vim.api.nvim_buf_set_text(0, unknown, column + 2 * (i - 1), unknown, column + 2 * (i - 1), { letter })
end
answer.fixed = await(function()
  return #answer.diagnostics > 0 and #vim.diagnostic.get(0) == 0
end)

local file = io.open(vim.env.PARTC_TEST_ANSWER, 'w')
file:write(vim.fn.json_encode(answer))
file:close()
vim.cmd('qall!')
