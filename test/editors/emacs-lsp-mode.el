;;; emacs-lsp-mode.el --- Tests part-mode with lsp-mode  -*- lexical-binding: t -*-

;; Run by scripts/editors-try.sh like emacs.el, if lsp-mode is installed.

(require 'package)
(package-initialize)
(unless (require 'lsp-mode nil t)
  (message "emacs-lsp-mode: lsp-mode is not installed")
  (kill-emacs 0))
(require 'lsp-diagnostics)
(require 'part-mode)

(defun try-await (what condition)
  "Waits until CONDITION is true, at most twenty seconds."
  (let ((end (+ (float-time) 20)))
    (while (not (funcall condition))
      (when (> (float-time) end)
        (message "emacs-lsp-mode: %s did not happen: %S" what (try-codes))
        (kill-emacs 1))
      (accept-process-output nil 0.05))))

(defun try-codes ()
  "The codes of the diagnostics of the buffer."
  (sort (mapcar (lambda (d) (gethash "code" d)) (lsp--get-buffer-diagnostics)) #'string<))

(let* ((folder (getenv "PARTC_TRY_FOLDER"))
       (file (expand-file-name "деталь.part" folder)))
  ;; lsp-mode 8.0.0 counts an emoji as one unit of UTF-16, so that every change after it is sent for a wrong
  ;; place. The program is tested without emoji.
  (with-temp-file file
    (insert-file-contents "test/programs/names/bad/beside-wide-letters.part")
    (while (search-forward "🙂" nil t) (replace-match "")))
  (setq lsp-auto-guess-root t
        lsp-restart 'ignore
        lsp-enable-snippet nil
        lsp-session-file (expand-file-name "session" folder))
  (find-file file)
  (lsp-workspace-folders-add folder)
  (lsp)
  (try-await "diagnostics" (lambda () (equal (try-codes) '("E0108" "E0201"))))
  (search-forward "лишнее")
  (replace-match "")
  (search-forward "неизвестно")
  (replace-match "длина")
  (lsp--flush-delayed-changes)
  (try-await "the end of the diagnostics" (lambda () (null (try-codes))))
  (save-buffer)
  (lsp-workspace-shutdown (car (lsp-workspaces))))

(message "emacs-lsp-mode: %s" (package-version-join (package-desc-version (cadr (assq 'lsp-mode package-alist)))))
