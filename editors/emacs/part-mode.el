;;; part-mode.el --- Part programs of partc  -*- lexical-binding: t -*-

;; Version: 0.1.0
;; Package-Requires: ((emacs "28.1"))
;; Keywords: languages
;; SPDX-License-Identifier: MIT

;;; Commentary:

;; A major mode for files that end in `.part'.  It colours and indents programs, lists their
;; definitions, and tells eglot and lsp-mode how the language server `partc lsp' is started.

;;; Code:

(require 'prog-mode)

(defgroup part nil
  "Part programs of partc."
  :group 'languages)

(defcustom part-server-command '("partc" "lsp")
  "The command that starts the language server, with its arguments."
  :type '(repeat string))

(defcustom part-indent-offset 2
  "The number of columns by which the text in braces is indented."
  :type 'natnum
  :safe #'natnump)

;; Words

(defconst part-mode-statements
  '("part" "machine" "import" "tool" "feed" "tolerance" "clearance" "from"
    "let" "param" "table" "curve" "piece" "contour" "assert"
    "mill" "turn" "drill" "rapid" "move" "change" "spindle" "coolant" "aux" "with")
  "The words that begin statements.")

(defconst part-mode-keywords
  '("for" "if" "in" "then" "else" "and" "or" "not"
    "open" "closed" "cw" "ccw"
    "meet" "near" "smooth" "tangent" "fillet" "chamfer" "slow" "allowance" "bevel"
    "outside" "inside" "left" "right" "on" "within" "first" "last" "approach" "retract")
  "The other words that cannot be names.")

(defconst part-mode-settings
  '("depth" "lead" "corners" "climb" "conventional" "compensation" "start" "plunge" "peck"
    "chip" "dwell" "pitch" "hand" "floating" "shortest" "islands" "rest" "angle"
    "ramp" "helix" "spiral" "tabs" "tab")
  "The words that begin settings, and that may be names as well.")

(defconst part-mode-functions
  '("polar" "intersection" "centre_of" "midpoint" "foot_of" "tangency" "point_on"
    "line" "horizontal" "vertical" "parallel" "perpendicular" "circle" "concentric"
    "distance" "direction_of" "radius_of" "length_of" "x_of" "y_of"
    "spline" "closed_spline" "bezier" "bspline" "polyline" "parabola" "arcs" "closed_arcs" "fit" "sections"
    "rows_of" "points_of" "point_at_x" "point_along" "length_along" "start_of" "end_of"
    "tangent_of" "normal_of" "curvature_of"
    "region" "union" "difference" "offset_of" "outlines_of" "holes_of" "area_of" "centroid_of"
    "rectangle" "bar" "rounded" "slot" "polygon" "ellipse" "gear"
    "moved" "rotated" "mirrored" "scaled" "reversed" "row" "grid" "around"
    "count_of" "item_of" "lift"
    "sin" "cos" "tan" "asin" "acos" "atan2" "sqrt" "abs" "min" "max" "floor")
  "The functions of the language.")

(defconst part-mode-constants '("pi" "true" "false")
  "The constants of the language.")

(defconst part-mode-units '("mm/min" "m/min" "in/min" "ft/min" "mm/rev" "in/rev" "mm" "cm" "m" "in" "deg" "rad" "rpm")
  "The units of numbers.")

;; Colours

(defconst part-mode-font-lock-keywords
  `((,(concat "^[ \t]*machine[ \t]+\\([[:alpha:]][[:alnum:].-]*\\)") 1 font-lock-constant-face)
    (,(concat "\\_<[0-9]+\\(?:\\.[0-9]+\\)?[ \t]*\\(" (regexp-opt part-mode-units) "\\)\\_>")
     1 font-lock-type-face)
    ("\\_<\\(?:part\\|let\\|param\\|table\\|curve\\|piece\\|contour\\)[ \t]+\\(\\(?:\\sw\\|\\s_\\)+\\)"
     1 font-lock-variable-name-face)
    ;; These words begin a line; elsewhere they are names.
    ("^[ \t]*\\(pocket\\|face\\|vcarve\\|work\\|program\\|safe\\|stock\\|avoid\\|contours\\|dwell\\|spot\\|ream\\|countersink\\|counterbore\\|bore\\|tap\\|thread\\)[ \t]+[(-]?\\(?:\\sw\\|\\s_\\)"
     1 font-lock-keyword-face)
    ("^[ \t]*\\(rest[ \t]+of\\)[ \t]" 1 font-lock-keyword-face)
    ("^[ \t]*\\(engrave\\)[ \t]+\"" 1 font-lock-keyword-face)
    ("^[ \t]*\\(?:engrave\\|contours\\)[ \t].*\\_<\\(at\\)\\_>.*\\_<\\(height\\)\\_>"
     (1 font-lock-keyword-face) (2 font-lock-keyword-face))
    ("^[ \t]*\\(?:engrave\\|contours\\)[ \t].*\\_<\\(direction\\|around\\)\\_>" 1 font-lock-keyword-face)
    ("^[ \t]*\\(?:engrave\\|contours\\)[ \t].*\\_<\\(align\\)[ \t]+\\(left\\|centre\\|right\\)\\_>"
     (1 font-lock-keyword-face) (2 font-lock-keyword-face))
    ("^[ \t]*pocket[ \t].*[ \t]\\(as\\)[ \t]" 1 font-lock-keyword-face)
    ("^[ \t]*\\(\\(?:optional[ \t]+\\)?stop\\)[ \t]*\\(?:--.*\\)?$" 1 font-lock-keyword-face)
    ("^[ \t]*\\(units\\)[ \t]+\\(mm\\|in\\)\\_>"
     (1 font-lock-keyword-face) (2 font-lock-type-face))
    (,(concat "\\(?:^\\|{\\)[ \t]*\\(" (regexp-opt part-mode-settings) "\\)\\_>")
     1 font-lock-keyword-face)
    ;; These words occur only after others; elsewhere they are names.
    ("\\_<lead[ \t]+\\(?:in\\|out\\)[ \t]+\\(line\\|arc\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<lead[ \t]+\\(out\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<\\(?:spindle\\|coolant\\)[ \t]+\\(off\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<spindle[ \t]+\\(manual\\)\\_>" 1 font-lock-keyword-face)
    ("^[ \t]*spindle[ \t].*\\_<\\(limit\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<change\\_>.*)[ \t]*\\(at\\)\\_>" 1 font-lock-keyword-face)
    ("^[ \t]*dwell[ \t].*\\_<\\(s\\)[ \t]*\\(?:--.*\\)?$" 1 font-lock-keyword-face)
    ("^[ \t]*\\(?:stock\\|avoid\\)[ \t].*?\\_<from\\_>.*?\\_<\\(to\\)\\_>" 1 font-lock-keyword-face)
    ("^[ \t]*\\(?:contours?\\|table\\)[ \t].*\\_<from[ \t]+\".*?\"[ \t]+\\(layer\\|id\\|class\\|unit\\|text\\)\\_>"
     1 font-lock-keyword-face)
    ("\\_<corners[ \t]+\\(round\\|sharp\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<compensation[ \t]+\\(compiler\\|controller\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<rest[ \t]+\\(allowed\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<\\(?:drill\\|spot\\|ream\\|countersink\\|counterbore\\|bore\\|tap\\|thread\\)[ \t]+\\(at\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<\\(?:spot\\|countersink\\|counterbore\\|bore\\|thread\\)[ \t]+at\\_>.*\\_<\\(diameter\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<\\(?:bore\\|tap\\|thread\\)[ \t]+at\\_>.*\\_<\\(pitch\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<countersink[ \t]+at\\_>.*\\_<\\(angle\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<chip[ \t]+\\(break\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<\\(cone\\|vbit\\|blade\\|tap\\|threadmill\\)(" 1 font-lock-keyword-face)
    ("(\\(diameter\\|nose\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<vbit(\\(angle\\)\\_>.*,[ \t]*\\(tip\\)\\_>.*,[ \t]*\\(diameter\\)\\_>"
     (1 font-lock-keyword-face) (2 font-lock-keyword-face) (3 font-lock-keyword-face))
    (",[ \t]*\\(height\\|gear\\)\\_>" 1 font-lock-keyword-face)
    (",[ \t]*\\(flutes\\|stickout\\|holder\\|angle\\|pitch\\)[ \t]+[(-]?\\(?:\\sw\\|\\s_\\)" 1 font-lock-keyword-face)
    (",[ \t]*holder[ \t]\\(?:[^,()\n]\\|([^()\n]*)\\)*\\_<\\(height\\)[ \t]" 1 font-lock-keyword-face)
    ("\\_<turn(.*,[ \t]*\\(tip\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<\\(cipher\\|joggle\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<joggle\\_>.*\\_<\\(to\\)\\_>.*\\_<\\(depth\\)\\_>.*\\_<\\(radius\\)\\_>"
     (1 font-lock-keyword-face) (2 font-lock-keyword-face) (3 font-lock-keyword-face))
    ("\\_<\\(?:drill\\|spot\\|ream\\|counterbore\\|bore\\|tap\\|thread\\)\\_>.*\\_<\\(depth\\)\\_>" 1 font-lock-keyword-face)
    ("\\_<\\(?:depth\\|pocket\\|rest\\|face\\)\\_>.*\\_<\\(step\\)\\_>" 1 font-lock-keyword-face)
    ("\\.\\..*\\_<\\(by\\)\\_>" 1 font-lock-keyword-face)
    (,(regexp-opt (append part-mode-statements part-mode-keywords) 'symbols) . font-lock-keyword-face)
    (,(regexp-opt part-mode-functions 'symbols) . font-lock-builtin-face)
    (,(regexp-opt part-mode-constants 'symbols) . font-lock-constant-face)
    ("\\_<\\(\\(?:\\sw\\|\\s_\\)+\\)(" 1 font-lock-function-name-face))
  "The colours of part programs.")

(defvar part-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?- ". 12" table)
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?\r ">" table)
    (modify-syntax-entry ?\" "\"" table)
    (modify-syntax-entry ?\\ "." table)
    (modify-syntax-entry ?' "." table)
    (modify-syntax-entry ?_ "_" table)
    (dolist (sign '(?+ ?* ?/ ?= ?< ?> ?! ?. ?,))
      (modify-syntax-entry sign "." table))
    table)
  "The syntax table of part programs.")

;; Indentation

(defun part-mode--line-depth ()
  "The number of open brackets before the first character of the current line.
The closing brackets with which the line begins are not counted.  Brackets
that open on one line count once."
  (save-excursion
    (back-to-indentation)
    (skip-chars-forward "])}")
    (let ((lines nil))
      (dolist (open (nth 9 (syntax-ppss)))
        (let ((line (line-number-at-pos open)))
          (unless (or (memq line lines) (= line (line-number-at-pos)))
            (push line lines))))
      (length lines))))

;; `partc fmt' aligns the columns of tables, and continues an expression further to the right.
(defun part-mode--may-be-further-right ()
  "True if the current line is a row of a table, or continues an expression."
  (save-excursion
    (back-to-indentation)
    (or (looking-at "[=<>!+*/.]\\|\\(?:and\\|or\\)\\_>")
        (let ((open (nth 1 (syntax-ppss))))
          (and open
               (not (eq (char-after) ?}))
               (eq (char-after open) ?{)
               (progn (goto-char open) (back-to-indentation) (looking-at "table\\_>")))))))

(defun part-mode-indent-line ()
  "Indents the current line by its depth in brackets.
Rows of tables and lines that continue an expression may be further to the
right."
  (interactive)
  (let ((column (* part-indent-offset (part-mode--line-depth))))
    (unless (and (> (current-indentation) column) (part-mode--may-be-further-right))
      (if (<= (current-column) (current-indentation))
          (indent-line-to column)
        (save-excursion (indent-line-to column))))))

;; Definitions

(defconst part-mode-imenu-generic-expression
  (mapcar
   (lambda (kind)
     (list (car kind)
           (concat "^[ \t]*" (cdr kind) "[ \t]+\\(\\(?:\\sw\\|\\s_\\)+\\)")
           1))
   '(("Part" . "part")
     ("Values" . "let")
     ("Parameters" . "param")
     ("Tables" . "table")
     ("Curves" . "curve")
     ("Pieces" . "piece")
     ("Contours" . "contour")))
  "The definitions of a program for imenu.")

;; The mode

;;;###autoload
(define-derived-mode part-mode prog-mode "Part"
  "A major mode for part programs of partc."
  (setq-local comment-start "-- "
              comment-end ""
              comment-start-skip "--+[ \t]*"
              indent-tabs-mode nil
              indent-line-function #'part-mode-indent-line
              electric-indent-chars (append "}])" electric-indent-chars)
              font-lock-defaults '(part-mode-font-lock-keywords)
              imenu-generic-expression part-mode-imenu-generic-expression
              imenu-case-fold-search nil)
  (when buffer-file-name
    (setq-local compile-command
                (concat "partc check --format short "
                        (shell-quote-argument (file-name-nondirectory buffer-file-name))))))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.part\\'" . part-mode))

;; Language server

(defvar eglot-server-programs)
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs
               (cons 'part-mode (lambda (&rest _) part-server-command))))

(defvar lsp-language-id-configuration)
(declare-function lsp-register-client "lsp-mode")
(declare-function make-lsp-client "lsp-mode")
(declare-function lsp-stdio-connection "lsp-mode")
(declare-function lsp-activate-on "lsp-mode")
(with-eval-after-load 'lsp-mode
  (add-to-list 'lsp-language-id-configuration '(part-mode . "part"))
  (lsp-register-client
   (make-lsp-client
    :new-connection (lsp-stdio-connection (lambda () part-server-command))
    :activation-fn (lsp-activate-on "part")
    :server-id 'partc)))

(provide 'part-mode)

;;; part-mode.el ends here
