if exists('b:did_ftplugin')
  finish
endif
let b:did_ftplugin = 1

setlocal commentstring=--\ %s comments=:--
setlocal expandtab shiftwidth=2 softtabstop=2
setlocal makeprg=partc\ check\ --format\ short\ %:S
setlocal errorformat=%f:%l:%c:\ %trror:\ %m,%f:%l:%c:\ %tarning:\ %m
let b:undo_ftplugin = 'setlocal commentstring< comments< expandtab< shiftwidth< softtabstop< makeprg< errorformat<'

lua require('partc').attach(vim.api.nvim_get_current_buf())
