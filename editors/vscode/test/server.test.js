// The extension with the real server: mistakes, values, definitions, and the life of the process.
const { afterEach, test } = require('node:test')
const assert = require('node:assert')
const { spawnSync } = require('child_process')
const fs = require('fs')
const path = require('path')
const { isDeepStrictEqual } = require('util')
const { activate, children, deactivate, partc, repository, stub, temporary, vscode } = require('./harness')

const setUp = () => {
  stub.reset()
  stub.configure('partc.path', partc)
}
setUp()
afterEach(setUp)

// The reports of `partc check` on a file as diagnostics: `start` and `end` are positions in UTF-16.
function reports(file) {
  const lines = fs.readFileSync(file, 'utf8').split('\n')
  const position = ({ line, column }) => ({
    line: line - 1,
    character: Array.from(lines[line - 1]).slice(0, column - 1).join('').length,
  })
  const { stderr } = spawnSync(partc, ['check', '--format', 'json', file], { encoding: 'utf8' })
  return stderr
    .split('\n')
    .filter((line) => line !== '')
    .map((line) => JSON.parse(line))
    .map(({ code, severity, title, start, end, related }) => ({
      code,
      severity,
      title,
      start: position(start),
      end: position(end),
      related: related.map(({ label, start, end }) => ({ label, start: position(start), end: position(end) })),
    }))
}

const plain = ({ line, character }) => ({ line, character })

// The diagnostics of the editor in the same form.
function shown(document) {
  return stub.diagnostics(document).map(({ code, severity, message, range, relatedInformation }) => ({
    code: code?.value ?? code,
    severity: severity === vscode.DiagnosticSeverity.Error ? 'error' : 'warning',
    title: message.split('\n')[0],
    start: plain(range.start),
    end: plain(range.end),
    related: (relatedInformation ?? []).map(({ message, location }) => ({
      label: message,
      start: plain(location.range.start),
      end: plain(location.range.end),
    })),
  }))
}

const flange = fs.readFileSync(path.join(repository, 'examples', 'flange.part'), 'utf8')
const faulty = flange.replace('fillet -36', 'fillet -3')

// Waits until the diagnostics are the reports of `partc check`. Those of the toolpath come after the others.
function areReported(document, file) {
  const expected = reports(file)
  assert.ok(expected.length > 0)
  return stub.until(() => isDeepStrictEqual(shown(document), expected), 'the diagnostics are those of partc check')
}

test('the diagnostics are those of partc check, and vanish with the mistake', async () => {
  const file = temporary('flange.part', faulty)
  const document = stub.open(file, 'part')
  const context = await activate()
  await areReported(document, file)
  assert.strictEqual(shown(document)[0].code, 'E0322')

  stub.edit(document, 'fillet -3 ', 'fillet -36 ')
  await stub.until(() => stub.diagnostics(document).length === 0, 'the diagnostics vanish')
  await document.save()
  assert.deepStrictEqual(reports(file), [])
  // The answer comes after the server has been told of the saving.
  assert.strictEqual((await stub.formatting(document, {})).length, 0)

  assert.strictEqual(children().length, 1)
  await deactivate(context)
  await stub.until(() => children().length === 0, 'the server ends')
  assert.deepStrictEqual(stub.messages, [])
  stub.close(document)
})

test('positions after letters of two UTF-16 units are right', async () => {
  const file = temporary('wide.part', flange.replace('cw boss(a - 90)', '/* 😀я */ cw boss(a - 90) nowhere'))
  const document = stub.open(file, 'part')
  const context = await activate()
  await areReported(document, file)
  await deactivate(context)
  stub.close(document)
})

test('hover, definition, outline and formatting are those of the server', async () => {
  const file = temporary('flange.part', flange.replace('feed      60', 'feed 60'))
  const document = stub.open(file, 'part')
  const context = await activate()
  const line = document.lines.findIndex((text) => text.startsWith('let lug'))
  const character = document.lines[line].indexOf('c +')
  const at = new vscode.Position(line, character)

  const hover = await stub.hover(document, at)
  assert.match(hover.contents.map((content) => content.value ?? content).join(), /59\.3/)
  const definition = [await stub.definition(document, at)].flat()[0]
  assert.strictEqual(document.lines[definition.range.start.line].startsWith('let c '), true)
  const symbols = await stub.symbols(document)
  const names = (list) => list.flatMap((symbol) => [symbol.name, ...names(symbol.children ?? [])])
  assert.ok(names(symbols).some((name) => name.includes('outline')), names(symbols).join())
  const edits = await stub.formatting(document, { tabSize: 2, insertSpaces: true })
  assert.ok(edits.map((edit) => edit.newText).join('').includes('feed      60'))

  await deactivate(context)
  stub.close(document)
})

test('the setting partc.trace.server writes the messages to the output channel', async () => {
  stub.configure('partc.trace.server', 'messages')
  const document = stub.open(temporary('flange.part', flange), 'part')
  const context = await activate()
  await stub.until(() => stub.log.some((line) => line.includes('textDocument/didOpen')), 'the message is written')
  await deactivate(context)
  stub.close(document)
})

test('a restart replaces the process', async () => {
  const file = temporary('flange.part', faulty)
  const document = stub.open(file, 'part')
  const context = await activate()
  const [before] = children()
  await vscode.commands.executeCommand('partc.restart')
  await stub.until(() => !children().includes(before), 'the first server ends')
  assert.strictEqual(children().length, 1)
  await stub.until(() => stub.diagnostics(document).length > 0, 'there are diagnostics again')
  assert.strictEqual(stub.collections.length, 1)
  await deactivate(context)
  await stub.until(() => children().length === 0, 'the server ends')
  stub.close(document)
})

test('without a part program no server runs, and the first one starts it', async () => {
  const context = await activate()
  assert.deepStrictEqual(children(), [])
  const document = stub.open(temporary('flange.part', faulty), 'part')
  await stub.until(() => stub.diagnostics(document).length > 0, 'there are diagnostics')
  await deactivate(context)
  await stub.until(() => children().length === 0, 'the server ends')
  stub.close(document)
})

test('if partc is missing, one message names the setting; the right setting mends it', async () => {
  stub.configure('partc.path', '/nowhere/partc')
  stub.answer = 'Open Settings'
  const document = stub.open(temporary('flange.part', faulty), 'part')
  const context = await activate()
  await stub.until(() => stub.messages.length === 2, 'there is a message, and the settings are opened')
  assert.strictEqual(stub.messages[0].severity, 'error')
  assert.match(stub.messages[0].text, /"\/nowhere\/partc".*partc\.path/)
  assert.strictEqual(stub.messages[1].text, 'workbench.action.openSettings partc')
  assert.deepStrictEqual(children(), [])

  stub.configure('partc.path', partc)
  stub.configurationChanged('partc.path')
  await stub.until(() => stub.diagnostics(document).length > 0, 'there are diagnostics')
  assert.strictEqual(stub.messages.length, 2)
  await deactivate(context)
  stub.close(document)
})

for (const [title, setting, value, message] of [
  ['a program that fails', 'path', 'false', /does not start.*partc\.path/],
  ['a program that is not partc', 'path', 'true', /"true" is not partc.*partc\.path/],
  ['a wrong argument', 'arguments', ['--nope'], /has no option --nope.*partc\.arguments/],
]) {
  test(`${title} gives one message`, async () => {
    stub.configure(`partc.${setting}`, value)
    const document = stub.open(temporary('flange.part', faulty), 'part')
    const context = await activate()
    await stub.until(() => stub.messages.length > 0, 'there is a message')
    assert.match(stub.messages[0].text, message)
    await deactivate(context)
    assert.strictEqual(stub.messages.length, 1)
    stub.close(document)
  })
}

test('a server that is killed starts again', async () => {
  const document = stub.open(temporary('flange.part', faulty), 'part')
  const context = await activate()
  await stub.until(() => stub.diagnostics(document).length > 0, 'there are diagnostics')
  const [killed] = children()
  process.kill(Number(killed), 'SIGKILL')
  await stub.until(() => children().length === 1 && !children().includes(killed), 'there is another server')
  stub.edit(document, 'fillet -3 ', 'fillet -36 ')
  await stub.until(() => stub.diagnostics(document).length === 0, 'the diagnostics vanish')
  await deactivate(context)
  await stub.until(() => children().length === 0, 'the server ends')
  stub.close(document)
})
