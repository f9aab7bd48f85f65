// Splits texts into tokens by the grammars of the extension, as VS Code does.
const fs = require('fs')
const path = require('path')
const oniguruma = require('vscode-oniguruma')
const { parseRawGrammar, Registry } = require('vscode-textmate')

const root = path.join(__dirname, '..')
const { contributes } = JSON.parse(fs.readFileSync(path.join(root, 'package.json'), 'utf8'))

async function grammars() {
  const wasm = path.join(path.dirname(require.resolve('vscode-oniguruma/package.json')), 'release', 'onig.wasm')
  await oniguruma.loadWASM(fs.readFileSync(wasm).buffer)
  const registry = new Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async (scope) => {
      const file = path.join(root, contributes.grammars.find(({ scopeName }) => scopeName === scope).path)
      return parseRawGrammar(fs.readFileSync(file, 'utf8'), file)
    },
  })
  const load = (language) => registry.loadGrammar(contributes.grammars.find((one) => one.language === language).scopeName)
  return { part: await load('part'), machine: await load('partc-machine'), sheet: await load('partc-sheet') }
}

// The tokens of a text without spaces: each with its text and its innermost scope, which is empty if it is only that of the
// language.
function tokens(grammar, text) {
  let stack = null
  return text.split('\n').flatMap((line) => {
    const result = grammar.tokenizeLine(line, stack)
    stack = result.ruleStack
    return result.tokens
      .map(({ startIndex, endIndex, scopes }) => ({
        text: line.slice(startIndex, endIndex).trim(),
        scope: scopes.length > 1 ? scopes.at(-1) : '',
      }))
      .filter((token) => token.text !== '')
  })
}

module.exports = { contributes, grammars, root, tokens }
