// The grammars know every word of the manuals, and find nothing wrong in the examples.
const { before, test } = require('node:test')
const assert = require('node:assert')
const fs = require('fs')
const path = require('path')
const { grammars, root, tokens } = require('./grammars')

const repository = path.join(root, '..', '..')
const read = (...file) => fs.readFileSync(path.join(repository, ...file), 'utf8')
const files = (folder, ending) =>
  fs.readdirSync(path.join(repository, folder)).filter((name) => name.endsWith(ending)).map((name) => path.join(folder, name))

let grammar
before(async () => {
  grammar = await grammars()
})

test('each reserved word of a program is a keyword or a unit', () => {
  const manual = read('docs', 'language.md')
  const block = manual.slice(manual.indexOf('These words cannot be names:'), manual.indexOf('The built-in functions'))
  const words = block.split('\n').filter((line) => line.startsWith('    ')).join(' ').trim().split(/\s+/)
  assert.ok(words.length > 60)
  const unknown = words.filter((word) => {
    const found = tokens(grammar.part, `x 7 ${word} y`).filter(({ text }) => text === word)
    return !found.some(({ scope }) => /^(keyword|storage)\./.test(scope))
  })
  assert.deepStrictEqual(unknown, [])
})

test('each function of the manual is a function', () => {
  const page = read('docs', 'functions.md')
  const called = [...page.matchAll(/^\| `([a-z_0-9]+)\(/gm)].map(([, name]) => name)
  assert.ok(called.length > 50)
  const unknown = called.filter((name) => tokens(grammar.part, `x ${name}(y)`)[1].scope !== 'support.function.part')
  assert.deepStrictEqual(unknown, [])
})

test('each word of the manual of machine descriptions has a scope', () => {
  const manual = read('docs', 'new-machine.md')
  // The sections after the one on lines, without its examples.
  const rows = manual.slice(manual.indexOf('## Sections'), manual.indexOf('## A complete description'))
  const cells = rows.split('\n').filter((line) => line.startsWith('| `')).map((line) => line.split('|')[1])
  const lines = cells.flatMap((cell) => [...cell.matchAll(/`([^`]+)`/g)].map(([, code]) => code))
  assert.ok(lines.length > 80)
  // Words that stand for others: a name that is chosen, a bit.
  const chosen = ['NAME', 'k']
  const unknown = lines.flatMap((line) =>
    tokens(grammar.machine, line)
      .filter(({ text, scope }) => scope === '' && /\p{L}/u.test(text) && !chosen.includes(text))
      .map(({ text }) => `${text} in ${line}`),
  )
  assert.deepStrictEqual(unknown, [])
})

test('the examples have no mistakes', () => {
  const all = [
    ...files('examples', '.part').map((file) => [grammar.part, file]),
    ...files('machines', '.machine').map((file) => [grammar.machine, file]),
    ...files('examples/machines', '.machine').map((file) => [grammar.machine, file]),
    ...files('examples', '.sheet').map((file) => [grammar.sheet, file]),
  ]
  assert.ok(all.length > 20)
  for (const [language, file] of all) {
    const wrong = tokens(language, read(file)).filter(({ scope }) => scope.startsWith('invalid'))
    assert.deepStrictEqual(wrong, [], file)
  }
})

test('in the descriptions of machines, only symbols and chosen names have no scope', () => {
  for (const file of [...files('machines', '.machine'), ...files('examples/machines', '.machine')]) {
    const text = read(file)
    const commands = [...text.matchAll(/ command ([\p{L}\w-]+)/gu)].map(([, name]) => name)
    const plain = tokens(grammar.machine, text).filter(({ text, scope }) => scope === '' && /\p{L}/u.test(text))
    const words = [...new Set(plain.map(({ text }) => text))]
    assert.deepStrictEqual(words.filter((word) => [...word].length > 1 && !commands.includes(word)), [], file)
  }
})
