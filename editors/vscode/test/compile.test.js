// The command that compiles, and the problem matcher that reads the reports of `partc`.
const { afterEach, test } = require('node:test')
const assert = require('node:assert')
const { spawnSync } = require('child_process')
const fs = require('fs')
const path = require('path')
const { activate, deactivate, partc, repository, root, stub, temporary, vscode } = require('./harness')

afterEach(() => stub.reset())

const { contributes, version } = JSON.parse(fs.readFileSync(path.join(root, 'package.json'), 'utf8'))
const [{ pattern }] = contributes.problemMatchers
const flange = fs.readFileSync(path.join(repository, 'examples', 'flange.part'), 'utf8')

// The lines of a text as VS Code would read them as problems; a line that it would not read is an error.
const problems = (text) =>
  text
    .split('\n')
    .filter((line) => line !== '')
    .map((line) => {
      const found = new RegExp(pattern.regexp).exec(line)
      assert.ok(found, `the problem matcher does not read: ${line}`)
      const names = ['file', 'line', 'column', 'severity', 'code', 'message']
      return Object.fromEntries(names.map((name) => [name, found[pattern[name]]]))
    })

// Runs a task as VS Code does.
const run = ({ execution }) =>
  spawnSync(execution.process, execution.args, { cwd: execution.options.cwd, encoding: 'utf8' })

test('a program without mistakes is compiled', async () => {
  stub.configure('partc.path', partc)
  const file = temporary('flange.part', flange)
  const document = stub.open(file, 'part')
  const context = await activate()
  stub.edit(document, '0.02 mm', '0.03 mm')
  await vscode.commands.executeCommand('partc.compile')
  assert.strictEqual(document.isDirty, false)
  assert.strictEqual(stub.tasks.length, 1)
  assert.strictEqual(stub.tasks[0].problemMatchers, '$partc')
  const { status, stderr } = run(stub.tasks[0])
  assert.deepStrictEqual([status, stderr], [0, ''])
  assert.ok(fs.existsSync(file.replace('.part', '.lkp-01f.tape')))
  await deactivate(context)
  stub.close(document)
})

test('the reports of a program with a mistake are problems', async () => {
  stub.configure('partc.path', partc)
  const file = temporary('a flange.part', flange.replace('fillet -36', 'fillet -3'))
  const document = stub.open(file, 'part')
  const context = await activate()
  await vscode.commands.executeCommand('partc.compile')
  const [{ message, ...problem }, ...others] = problems(run(stub.tasks[0]).stderr)
  assert.match(message, /no counter-clockwise arc of radius 3 mm/)
  assert.deepStrictEqual([problem, ...others], [
    {
      file,
      line: '20',
      column: '23',
      severity: 'error',
      code: 'E0322',
    },
  ])
  await deactivate(context)
  stub.close(document)
})

test('the arguments of the user are those of the compiler', async () => {
  stub.configure('partc.path', partc)
  stub.configure('partc.arguments', ['--set', 'bolt=12'])
  const file = temporary('spacer.part', fs.readFileSync(path.join(repository, 'examples', 'spacer.part'), 'utf8'))
  const document = stub.open(file, 'part')
  const context = await activate()
  await vscode.commands.executeCommand('partc.compile')
  assert.deepStrictEqual(stub.tasks[0].execution.args, [
    'compile', '--format', 'short', '--set', 'bolt=12', '--', file,
  ])
  assert.strictEqual(run(stub.tasks[0]).status, 0)
  await deactivate(context)
  stub.close(document)
})

test('every short report of the wrong programs of the tests is a problem', () => {
  const bad = fs
    .readdirSync(path.join(repository, 'test', 'programs'), { withFileTypes: true })
    .filter((entry) => entry.isDirectory())
    .map((entry) => path.join(repository, 'test', 'programs', entry.name, 'bad'))
    .filter((folder) => fs.existsSync(folder))
    .flatMap((folder) => fs.readdirSync(folder).map((name) => path.join(folder, name)))
    .filter((file) => file.endsWith('.part'))
  assert.ok(bad.length > 100)
  const { stderr } = spawnSync(partc, ['check', '--format', 'short', ...bad], {
    encoding: 'utf8',
    maxBuffer: 2 ** 26,
  })
  const found = problems(stderr)
  assert.ok(found.length > 100)
  for (const { file } of found) assert.ok(fs.existsSync(file), file)
})

test('without a program there is a message, and no task', async () => {
  const context = await activate()
  await vscode.commands.executeCommand('partc.compile')
  assert.strictEqual(stub.messages.length, 1)
  assert.deepStrictEqual(stub.tasks, [])
  await deactivate(context)
})

test('the version is that of partc', () => {
  const text = fs.readFileSync(path.join(repository, 'package.yaml'), 'utf8')
  const [, whole] = /^version: *(.*)$/m.exec(text)
  assert.strictEqual(version, whole.split('.').slice(0, 3).join('.'))
})

test('each command of the description is registered', async () => {
  const context = await activate()
  const registered = stub.commands()
  assert.deepStrictEqual(contributes.commands.map(({ command }) => command).sort(), registered.sort())
  await deactivate(context)
})
