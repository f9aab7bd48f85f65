// The configurations of the three languages, and the snippets.
const { test } = require('node:test')
const assert = require('node:assert')
const { spawnSync } = require('child_process')
const fs = require('fs')
const os = require('os')
const path = require('path')
const { contributes, root } = require('./grammars')

const partc = process.env.PARTC || 'partc'
const repository = path.join(root, '..', '..')
const json = (...file) => JSON.parse(fs.readFileSync(path.join(root, ...file), 'utf8'))
const examples = (folder, ending) =>
  fs
    .readdirSync(path.join(repository, folder))
    .filter((name) => name.endsWith(ending))
    .map((name) => path.join(repository, folder, name))

test('every file that the description names exists', () => {
  const named = [
    ...contributes.languages.flatMap(({ configuration, icon }) => [configuration, icon.light, icon.dark]),
    ...contributes.grammars.map(({ path }) => path),
    ...contributes.snippets.map(({ path }) => path),
  ]
  for (const file of named) assert.ok(fs.existsSync(path.join(root, file)), file)
})

// The lines whose indentation differs from that which the rules give after the line before. Lines within a table are
// aligned, and a line that continues a statement may be further in, so both are skipped.
function misplaced(rules, text) {
  const [increase, decrease] = [rules.increaseIndentPattern, rules.decreaseIndentPattern].map((rule) => new RegExp(rule))
  let depth = 0
  let inTable = false
  return text.split('\n').filter((line) => {
    if (line.trim() === '') return false
    if (decrease.test(line)) depth -= 1
    if (decrease.test(line)) inTable = false
    const indentation = line.length - line.trimStart().length
    const wrong = !inTable && indentation !== 2 * depth
    if (increase.test(line)) depth += 1
    if (/^\s*table\b.*\{/.test(line)) inTable = true
    return wrong
  })
}

test('the rules of indentation give the layout of the examples', () => {
  const part = json('languages', 'part.json').indentationRules
  for (const file of examples('examples', '.part'))
    assert.deepStrictEqual(misplaced(part, fs.readFileSync(file, 'utf8')), [], file)
  const machine = json('languages', 'machine.json').indentationRules
  for (const file of [...examples('machines', '.machine'), ...examples('examples/machines', '.machine')])
    assert.deepStrictEqual(misplaced(machine, fs.readFileSync(file, 'utf8')), [], file)
})

test('the pattern of a word takes a name as a whole', () => {
  const words = (file, text) => {
    const { pattern, flags } = json('languages', file).wordPattern
    return text.match(new RegExp(pattern, `g${flags}`))
  }
  assert.deepStrictEqual(words('part.json', 'cw бобышка_1(a - 2.5)'), ['cw', 'бобышка_1', 'a', '2.5'])
  assert.deepStrictEqual(words('machine.json', 'machine kontur-2p'), ['machine', 'kontur-2p'])
})

// The text of a snippet with the values that it proposes.
function expanded({ body }) {
  const value = (text) => {
    const next = text
      .replace(/\$\{\d+\|([^,|]*)[^|]*\|\}/g, '$1')
      .replace(/\$\{\d+:([^${}]*)\}/g, '$1')
      .replace(/\$\d+/g, '')
    return next === text ? text : value(next)
  }
  return `${value(body.join('\n')).replace(/\\\\/g, '\\')}\n`
}

const part = json('snippets', 'part.json')
const head = expanded(part.Program)
// A machine that moves z.
const deep = head.replace('lkp-01f', 'n55')
const table = expanded(part.Table)

// What has to be above a snippet in a program.
const above = {
  Program: '',
  Curve: head + table,
  Piece: `${head + table + expanded(part.Curve)}\n`,
  Mill: deep + expanded(part.Contour),
  Pocket: `${deep}contour recess closed {\n  ccw circle((30, 20), 25)\n}\n`,
  Drill: deep.replace('mill(', 'drill('),
  Turn: `${head.replace(/mill\(.*\)/, 'turn(nose 0.4 mm)')}contour profile open {\n  (0, 10)\n  (40, 10)\n}\n`,
}

// Writes a text into a new folder that also has the imports of the examples; the path of its file.
function temporary(t, name, text) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'partc-vscode-'))
  t.after(() => fs.rmSync(folder, { recursive: true }))
  fs.cpSync(path.join(repository, 'examples', 'lib'), path.join(folder, 'lib'), { recursive: true })
  fs.writeFileSync(path.join(folder, name), text)
  return path.join(folder, name)
}

function run(...parameters) {
  const { status, stderr, stdout } = spawnSync(partc, parameters, { encoding: 'utf8' })
  return { status, text: stdout + stderr }
}

for (const [name, snippet] of Object.entries(part)) {
  test(`the snippet ${name} is right in a program, and laid out as partc fmt does it`, (t) => {
    const text = (above[name] ?? head) + expanded(snippet)
    const file = temporary(t, 'a.part', text)
    const { status, text: output } = run('check', '--werror', file)
    assert.strictEqual(status, 0, `${text}\n${output}`)
    run('fmt', file)
    const lines = (layout) => layout.split('\n').filter((line) => line.trim() !== '')
    assert.deepStrictEqual(lines(fs.readFileSync(file, 'utf8')), lines(text))
  })
}

test('the snippet for a program offers every built-in machine', () => {
  const offered = /\|([^|]*)\|/.exec(part.Program.body.find((line) => line.startsWith('machine')))[1].split(',')
  const machines = examples('machines', '.machine').map((file) => path.basename(file, '.machine'))
  assert.deepStrictEqual(offered.sort(), machines.sort())
})

test('the snippets for machines make a description', (t) => {
  const { Machine, Axis, Word, ...others } = json('snippets', 'machine.json')
  const description = expanded(Machine)
  const rotary = expanded(others['Rotary axis'])
  const inFrame = (text) => text.split('\n').map((line) => (line === '' ? '' : `  ${line}`)).join('\n')
  const command = inFrame(expanded(others['Command word']))
  const along = inFrame(expanded(Word)).replace('"X"', '"A"').replace('along x', 'along a')
  const whole = description
    .replace(/axis x \{[^}]*\}\n/, expanded(Axis))
    .replace('arcs any', `${rotary}\narcs any`)
    .replace('  symbols "\\n"', `${along}${command}  symbols "\\n"`)
  const flange = path.join(repository, 'examples', 'flange.part')
  for (const text of [description, whole]) {
    const file = temporary(t, 'shop.machine', text)
    const { status, text: output } = run('compile', '-t', file, flange, '-o', path.dirname(file))
    assert.strictEqual(status, 0, `${text}\n${output}`)
  }
  assert.notStrictEqual(whole, description)
})

test('the snippet for a sheet is a right sheet', (t) => {
  const file = temporary(t, 'a.sheet', expanded(json('snippets', 'sheet.json').Sheet))
  const { status, text } = run('compile', file)
  assert.strictEqual(status, 0, text)
})
