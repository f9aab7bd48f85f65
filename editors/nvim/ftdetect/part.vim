autocmd BufRead,BufNewFile *.part setfiletype part
