;;; emacs.el --- Tests part-mode with the real server  -*- lexical-binding: t -*-

;; Run by scripts/editors-try.sh as
;;   emacs -q --batch -L editors/emacs -l test/editors/emacs.el
;; in the folder of the sources.  PARTC_TRY_FOLDER is a folder that it may write to.

(require 'package)
(package-initialize)
(require 'part-mode)
(require 'cl-lib)
(require 'eglot)
(require 'flymake)
(require 'imenu)

(defun try-fail (&rest words)
  "Ends Emacs with the status 1 and a message."
  (message "emacs: %s" (apply #'format words))
  (ignore-errors (eglot-shutdown-all))
  (kill-emacs 1))

(defun try-await (what condition)
  "Waits until CONDITION is true, at most twenty seconds."
  (let ((end (+ (float-time) 20)) (found nil))
    (while (and (not (setq found (funcall condition))) (< (float-time) end))
      (accept-process-output nil 0.05))
    (or found (try-fail "%s did not happen" what))))

(defun try-equal (what expected found)
  "Fails if two values differ."
  (unless (equal expected found)
    (try-fail "%s: expected %S, found %S" what expected found)))

(defun try-folder (name)
  (expand-file-name name (getenv "PARTC_TRY_FOLDER")))

(defun try-open (program name)
  "Opens a copy of PROGRAM under NAME and starts the server for it.  Gives the buffer."
  (let ((file (try-folder name)))
    (copy-file program file t)
    (let ((buffer (find-file-noselect file)))
      (with-current-buffer buffer
        (apply #'eglot (eglot--guess-contact))
        (try-await "the start of the server" #'eglot-managed-p)
        (flymake-start))
      buffer)))

;; Diagnostics

(defun try-position (place)
  "The position in the buffer of a line and column of `partc check'."
  (save-excursion
    (goto-char (point-min))
    (forward-line (1- (gethash "line" place)))
    (+ (point) (1- (gethash "column" place)))))

(defun try-reported ()
  "The reports of `partc check' on the file of the buffer: beginning, end, code, kind."
  (let* ((file buffer-file-name)
         (lines (with-temp-buffer
                  (call-process "partc" nil t nil "check" "--format" "json" file)
                  (split-string (buffer-string) "\n" t))))
    (sort
     (mapcar
      (lambda (line)
        (let ((report (json-parse-string line)))
          (list (try-position (gethash "start" report))
                (try-position (gethash "end" report))
                (gethash "code" report)
                (if (equal (gethash "severity" report) "error") 'eglot-error 'eglot-warning))))
      lines)
     #'try-before)))

(defun try-before (a b)
  (string< (format "%08d %s" (car a) (nth 2 a)) (format "%08d %s" (car b) (nth 2 b))))

(defun try-shown ()
  "The diagnostics that Flymake has for the buffer, in the form of `try-reported'."
  (sort
   (mapcar
    (lambda (d)
      (list (flymake-diagnostic-beg d)
            (flymake-diagnostic-end d)
            (plist-get (cdr (assq 'eglot-lsp-diag (flymake-diagnostic-data d))) :code)
            (flymake-diagnostic-type d)))
    (flymake-diagnostics))
   #'try-before))

(defun try-diagnostics (program name)
  (with-current-buffer (try-open program name)
    (let ((expected (try-reported)))
      (when expected
        (try-await (format "a diagnostic in %s" program) #'try-shown)
        (try-equal program expected (try-shown))))
    (current-buffer)))

;; The mode without the server

(defun try-face (word)
  "The face of the first occurrence of WORD in the buffer."
  (goto-char (point-min))
  (search-forward word)
  (get-text-property (match-beginning 0) 'face))

(copy-file "examples/рычаг.part" (try-folder "рычаг.part") t)
(with-current-buffer (find-file-noselect (try-folder "рычаг.part"))
  (try-equal "mode" 'part-mode major-mode)
  (font-lock-ensure)
  (try-equal "comment" 'font-lock-comment-face (try-face "Рычаг"))
  (try-equal "text" 'font-lock-string-face (try-face "Рычаг, черт"))
  (try-equal "statement" 'font-lock-keyword-face (try-face "tolerance"))
  (try-equal "machine" 'font-lock-constant-face (try-face "lkp-01f"))
  (try-equal "unit" 'font-lock-type-face (try-face "mm/min"))
  (try-equal "definition" 'font-lock-variable-name-face (try-face "палец"))
  (try-equal "function" 'font-lock-builtin-face (try-face "polar"))
  (try-equal "setting" 'font-lock-keyword-face (try-face "plunge"))
  (try-equal "number" nil (try-face "110"))
  (let ((index (imenu--make-index-alist t)))
    (try-equal "contours" '("обвод" "отверстие_ступицы" "отверстие_бобышки")
               (mapcar #'car (cdr (assoc "Contours" index)))))
  (goto-char (point-min))
  (search-forward "let ось")
  (beginning-of-line)
  (comment-line 1)
  (forward-line -1)
  (try-equal "comment command" t (looking-at-p "-- let ось"))
  (set-buffer-modified-p nil)
  (kill-buffer))

(dolist (file (append (file-expand-wildcards "examples/*.part")
                      (file-expand-wildcards "test/programs/*/good/*.part")))
  (with-temp-buffer
    (insert-file-contents file)
    (part-mode)
    (let ((before (buffer-string)) (inhibit-message t))
      (indent-region (point-min) (point-max))
      (try-equal (concat "indentation of " file) before (buffer-string)))))

(with-temp-buffer
  (part-mode)
  (electric-indent-local-mode 1)
  (electric-pair-local-mode 1)
  (cl-flet ((type (text) (mapc (lambda (c)
                                 (if (eq c ?\n) (call-interactively #'newline)
                                   (let ((last-command-event c))
                                     (call-interactively #'self-insert-command))))
                               text)))
    (type "contour a closed {\nfor p in [(0, 0)] {\np"))
  (try-equal "typed text" "contour a closed {\n  for p in [(0, 0)] {\n    p\n  }\n}"
             (buffer-string)))

;; The server

(setq eglot-sync-connect 20 eglot-autoshutdown t eglot-confirm-server-initiated-edits nil)

(let ((found (cdr (assq 'part-mode eglot-server-programs))))
  (try-equal "eglot's command" '("partc" "lsp") (funcall found)))

(dolist (program (file-expand-wildcards "test/programs/names/bad/*.part"))
  (with-current-buffer (try-diagnostics program (concat "деталь-" (file-name-nondirectory program)))
    (eglot-shutdown (eglot-current-server))
    (kill-buffer)))

(with-current-buffer (try-diagnostics "test/programs/names/bad/beside-wide-letters.part" "деталь.part")
  ;; Both mistakes are removed, and so are their diagnostics.
  (goto-char (point-min))
  (search-forward "лишнее")
  (replace-match "")
  (search-forward "неизвестно")
  (replace-match "длина")
  (eglot--signal-textDocument/didChange)
  (try-await "the end of the diagnostics" (lambda () (null (try-shown))))
  (save-buffer)
  (try-equal "partc check of the corrected program" nil (try-reported))

  (goto-char (point-max))
  (search-backward "длина")
  (xref-find-definitions "LSP identifier at point.")
  (try-equal "line of the definition" 7 (line-number-at-pos))

  (let ((hover (jsonrpc-request (eglot-current-server) :textDocument/hover
                                (eglot--TextDocumentPositionParams))))
    (try-equal "hover" t (and (string-match-p "длина = 41 mm" (format "%S" hover)) t)))

  (try-equal "outline" t (and (assoc "длина" (cl-mapcan (lambda (e) (if (listp (cdr e)) (copy-sequence (cdr e)) (list e)))
                                                        (eglot-imenu)))
                              t))

  ;; A misspelt name is mended by its fix.
  (goto-char (point-max))
  (search-backward "длина)")
  (replace-match "длинна)")
  (search-backward "длинна")
  (eglot--signal-textDocument/didChange)
  (try-await "the diagnostic of the misspelt name" (lambda () (= 1 (length (try-shown)))))
  (let ((actions (jsonrpc-request
                  (eglot-current-server) :textDocument/codeAction
                  (list :textDocument (eglot--TextDocumentIdentifier)
                        :range (list :start (eglot--pos-to-lsp-position (point))
                                     :end (eglot--pos-to-lsp-position (point)))
                        :context (list :diagnostics [])))))
    (eglot--apply-workspace-edit (plist-get (elt actions 0) :edit))
    (eglot--signal-textDocument/didChange)
    (try-await "the end of the misspelt name" (lambda () (null (try-shown)))))

  ;; The name is completed after its first letters.
  (goto-char (point-max))
  (search-backward "длина)")
  (replace-match "дли)")
  (goto-char (1- (point)))
  (eglot--signal-textDocument/didChange)
  (let ((table (nth 2 (eglot-completion-at-point))))
    (try-equal "completion" t (and (member "длина" (all-completions "дли" table)) t)))
  (insert "на")
  (eglot--signal-textDocument/didChange)
  (try-await "the end of the diagnostics" (lambda () (null (try-shown))))

  (when (eglot--server-capable :renameProvider)
    (goto-char (point-min))
    (search-forward "let длина")
    (backward-char)
    (eglot-rename "длина_детали")
    (try-equal "old name after renaming" nil
               (save-excursion (goto-char (point-min)) (re-search-forward "\\_<длина\\_>" nil t)))
    (save-buffer)
    (try-equal "partc check after renaming" nil (try-reported)))

  (let ((expected (with-temp-buffer
                    (let ((copy (try-folder "formatted.part")) (text nil))
                      (copy-file (try-folder "деталь.part") copy t)
                      (call-process "partc" nil nil nil "fmt" copy)
                      (insert-file-contents copy)
                      (setq text (buffer-string))
                      text))))
    (eglot-format-buffer)
    (try-equal "formatted text" expected (buffer-string))
    (save-buffer))
  (eglot-shutdown (eglot-current-server))
  (kill-buffer))

(message "emacs: %s with eglot %s" emacs-version
         (if (assq 'eglot package-alist)
             (package-version-join (package-desc-version (cadr (assq 'eglot package-alist))))
           "of its own"))
