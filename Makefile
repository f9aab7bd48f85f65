# The targets for building partc and working on it. `make` alone lists them.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help
MAKEFLAGS += --no-print-directory

# Part programs contain Russian text. Without this setting a fresh system does not use UTF-8.
export LC_ALL := C.UTF-8

PREFIX ?= /usr/local
STACK ?= stack
# Arguments for the test runner: make test TEST='--match Geometry' or TEST='--match "an axis in"'
TEST ?=

# Builds with different flags have folders of their own, so that none overwrites the objects of another.
CHECK := $(STACK) --work-dir .stack-work-check
BENCH := $(STACK) --work-dir .stack-work-bench
# The build for `make test TEST=...`. Without optimisation, a changed function recompiles its module only,
# not all modules that use it.
QUICK := $(STACK) --work-dir .stack-work-quick

TESTED := $(if $(TEST),$(QUICK),$(STACK))
UNOPTIMISED := $(if $(TEST),--fast)

DEMO := flange
MACHINE := lkp-01f

# Ormolu 0.3 does not read package.yaml, which turns this extension on for the compiler.
ORMOLU := ormolu -o -XImportQualifiedPost

HS_FILES = $(shell find src app test bench -name '*.hs' 2>/dev/null | sort)
# The package and the archive are written here.
PACKED := build/packages

PARTC = $$($(STACK) path --local-install-root 2>/dev/null)/bin/partc

# npm in the folder of the extension for VS Code. No package needs to run a script of its own when it is installed.
NPM := npm --prefix editors/vscode
NPM_CI := $(NPM) ci --ignore-scripts --no-audit --no-fund

banner = @printf '== %s\n' '$(1)'
quietly = @bash scripts/quietly.sh

.PHONY: preview-bench gallery mutants preview-test pictures tree-sitter-test editors-test controls-test client-test vsix vscode-test help setup build test check format format-check lint commits bench demo install deb dist deb-try clean

help: ## this list
	@printf 'make demo|test|...\n\n'
	@sed -nE 's/^([a-z-]+):[^#]*## (.*)/  \1\t\2/p' $(MAKEFILE_LIST) | expand -t 20

setup: ## install all Debian packages that are missing, and the commit hook
	@bash scripts/setup.sh
	@bash scripts/commit-hook.sh

# needs-GROUP installs the packages of one group of scripts/packages.txt.
needs-%:
	@bash scripts/setup.sh $*

build: needs-build ## build the library and the program
	$(call banner,build)
	$(quietly) $(STACK) build

test: needs-build needs-test ## build and run all tests; TEST='--match WORD' runs some, quickly built
	$(call banner,build with tests)
	$(quietly) $(TESTED) build $(UNOPTIMISED) --test --no-run-tests
	$(call banner,test)
	@$(TESTED) --verbosity warn test $(UNOPTIMISED) --test-arguments '$(TEST)'

check: needs-build needs-test format-check lint commits controls-test ## everything a change must pass: format, lint, commits, checkers, warnings, tests
	$(call banner,build with warnings as errors)
	$(quietly) $(CHECK) build --flag partc:werror --test --no-run-tests
	$(call banner,test)
	@$(CHECK) --verbosity warn test --flag partc:werror

format: needs-check ## lay out every Haskell file with ormolu
	$(call banner,format)
	@$(ORMOLU) --mode inplace $(HS_FILES)

format-check: needs-check ## fail when ormolu would change a file
	$(call banner,format check)
	@$(ORMOLU) --mode check $(HS_FILES)

lint: needs-check ## run hlint over every Haskell file
	$(call banner,lint)
	@hlint --no-summary $(HS_FILES)

commits: ## check the commit hook and the subjects of commits
	$(call banner,commits)
	@bash scripts/commits-try.sh
	@bash scripts/commits.sh

bench: needs-build needs-test ## time the kernel, the stages, the whole compile; BEFORE=FOLDER compares
	$(call banner,build with benchmark)
	$(quietly) $(BENCH) build --flag partc:bench --bench --no-run-benchmarks
	$(if $(BEFORE),$(call banner,build of the earlier state))
	$(if $(BEFORE),@cd "$(BEFORE)" && $(BENCH) build --flag partc:bench --bench --no-run-benchmarks)
	$(call banner,bench)
	@bash scripts/bench.sh "$$($(BENCH) path --dist-dir)" $(if $(BEFORE),"$(BEFORE)/$$(cd "$(BEFORE)" && $(BENCH) path --dist-dir)")

pictures: needs-build needs-test ## draw the pictures of the documents anew from their programs
	$(call banner,build with tests)
	$(quietly) $(STACK) build --test --no-run-tests
	$(call banner,pictures)
	@PARTC_RECORD=1 $(STACK) --verbosity warn test --test-arguments "--match pictures"

gallery: build ## draw the pictures of docs/gallery.md anew
	$(call banner,gallery)
	@bash scripts/gallery.sh "$(PARTC)"

mutants: needs-build needs-test ## put one bug into the code for every law; fail if the law does not notice it
	$(call banner,mutants)
	@bash scripts/mutants.sh $(MUTANTS)

tree-sitter-test: build ## test the grammar for tree-sitter; needs tree-sitter-cli
	$(call banner,tree-sitter)
	@bash scripts/tree-sitter-try.sh "$(PARTC)"

editors-test: build ## try the editors that are installed, each with the language server
	$(call banner,editors)
	@bash scripts/editors-try.sh "$(PARTC)"

# The examples are tried if partc is built, or with PARTC=FILE.
controls-test: needs-test ## test the checkers of G-code, and by them the examples for modern controls
	$(call banner,controls)
	@python3 -B -m unittest discover -s test/controls
	$(call banner,examples for modern controls)
	@partc="$(PARTC)" || true; \
	  if [[ -x "$$partc" ]]; then python3 -B test/controls/examples.py "$$partc"; \
	  else echo 'partc is not built: examples/cnc is not tried'; fi

demo: build ## compile, prove, report and draw an example part
	@mkdir -p build
	$(call banner,compile examples/$(DEMO).part for $(MACHINE))
	@$(PARTC) compile examples/$(DEMO).part -t $(MACHINE) -o build/
	$(call banner,verify)
	@$(PARTC) verify examples/$(DEMO).part -t $(MACHINE) build/$(DEMO).$(MACHINE).tape
	$(call banner,report)
	@$(PARTC) report examples/$(DEMO).part -t $(MACHINE)
	$(call banner,plot)
	@$(PARTC) plot examples/$(DEMO).part -o build/$(DEMO).svg
	@printf 'tape:    build/%s\npicture: build/%s\n' '$(DEMO).$(MACHINE).tape' '$(DEMO).svg'

install: build ## copy partc to $(PREFIX)/bin
	$(call banner,install)
	@install -D -m 755 "$(PARTC)" "$(DESTDIR)$(PREFIX)/bin/partc"
	@install -D -m 644 docs/partc.1 "$(DESTDIR)$(PREFIX)/share/man/man1/partc.1"
	@printf 'installed %s\n' '$(DESTDIR)$(PREFIX)/bin/partc'

deb: build needs-package ## make a Debian package
	$(call banner,deb)
	@bash scripts/package.sh deb "$(PARTC)" $(PACKED)

dist: build needs-package ## make an archive that runs on a Debian 12 without Haskell
	$(call banner,dist)
	@bash scripts/package.sh dist "$(PARTC)" $(PACKED)

deb-try: build needs-package needs-try ## install the package and the archive in a Debian 12 without Haskell; needs root
	$(call banner,deb and dist)
	@deb=$$(bash scripts/package.sh deb "$(PARTC)" $(PACKED)) && \
	  archive=$$(bash scripts/package.sh dist "$(PARTC)" $(PACKED)) && \
	  printf '%s\n' "$$deb" "$$archive" && \
	  bash scripts/package-try.sh "$(PARTC)" "$$deb" "$$archive"

vsix: needs-vscode ## pack the extension for VS Code: build/partc-VERSION.vsix
	$(call banner,libraries from npm)
	$(quietly) $(NPM_CI)
	@mkdir -p build
	$(call banner,compile and pack)
	$(quietly) $(NPM) run package -- --out "$(CURDIR)/build/"
	@printf 'extension: build/partc-%s.vsix\n' "$$(node -p 'require("./editors/vscode/package.json").version')"

# With PARTC=FILE, this built program is tested, and none is built.
client-test: build ## drive the language server by a client in Python; fetches its libraries
	$(call banner,client)
	@bash scripts/client-test.sh "$(PARTC)"

vscode-test: needs-vscode $(if $(filter command,$(origin PARTC)),,build) ## test the extension for VS Code with node, without VS Code
	$(call banner,libraries from npm)
	$(quietly) $(NPM_CI)
	$(call banner,compile)
	$(quietly) $(NPM) run compile
	$(call banner,test)
	@PARTC="$(PARTC)" $(NPM) --silent test

# Node.js may come from elsewhere than Debian; then its package is not needed.
preview-test: needs-preview $(if $(shell command -v npm),,needs-vscode) $(if $(filter command,$(origin PARTC)),,build) ## test the page of the preview in Chromium; screenshots in build/preview
	$(call banner,libraries from npm)
	$(quietly) npm --prefix test/browser ci --ignore-scripts --no-audit --no-fund
	$(call banner,lint and test)
	@PARTC="$(PARTC)" bash scripts/preview-test.sh

preview-bench: needs-preview build ## measure the preview with large programs, in Chromium
	$(quietly) npm --prefix test/browser ci --ignore-scripts --no-audit --no-fund
	@PARTC="$(PARTC)" node test/browser/measure.mjs

clean: ## remove everything that was built
	@rm -rf .stack-work .stack-work-check .stack-work-bench .stack-work-quick build partc.cabal
	@rm -rf editors/vscode/node_modules editors/vscode/out test/browser/node_modules
