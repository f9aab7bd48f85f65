// The panel: what it asks the server, and what its page shows.
const { afterEach, test } = require('node:test')
const assert = require('node:assert')
const fs = require('fs')
const path = require('path')
const vm = require('vm')
const { activate, deactivate, partc, repository, root, stub, temporary, vscode } = require('./harness')

afterEach(() => stub.reset())

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms))
const last = (panel) => panel.posted.at(-1)

// Opens a text, activates the extension with this program, and shows the panel.
async function shown(program, text) {
  stub.configure('partc.path', program)
  const document = stub.open(temporary('деталь 1.part', text), 'part')
  const context = await activate()
  await vscode.commands.executeCommand('partc.showPicture')
  const [panel] = stub.panels
  const end = async () => {
    await deactivate(context)
    stub.close(document)
    assert.deepStrictEqual(stub.panels, [])
  }
  return { document, panel, end }
}

const later = path.join(__dirname, 'fake-partc.js')

test('the panel follows the cursor', async () => {
  const { document, panel, end } = await shown(later, 'one\ntwo\ndrawn\nnothing\n')
  await stub.until(() => panel.posted.length === 1, 'the panel shows something')
  assert.deepStrictEqual(last(panel), { title: 'one', rows: [['question', '1']] })
  stub.moveCursor(2, 0)
  await stub.until(() => panel.posted.length === 2, 'the panel follows')
  assert.deepStrictEqual(last(panel), { title: 'drawn', rows: [['question', '2']], svg: '<svg>#1</svg>' })
  stub.moveCursor(3, 0)
  await stub.until(() => panel.posted.length === 3, 'the panel follows')
  assert.deepStrictEqual(last(panel), { sentence: 'There is nothing to show at the cursor.' })

  // A second call of the command does not make a second panel.
  await vscode.commands.executeCommand('partc.showPicture')
  assert.strictEqual(stub.panels.length, 1)
  await stub.until(() => panel.posted.length === 4, 'the panel shows the same again')
  assert.strictEqual(document.version, 1)
  await end()
})

test('many movements within 100 ms are one question', async () => {
  const { panel, end } = await shown(later, 'one\ntwo\nthree\n')
  await stub.until(() => panel.posted.length === 1, 'the panel shows something')
  for (const line of [1, 2, 1, 2]) stub.moveCursor(line, 0)
  await stub.until(() => panel.posted.length === 2, 'the panel follows')
  assert.deepStrictEqual(last(panel), { title: 'three', rows: [['question', '2']] })
  await end()
})

test('a late answer does not replace a newer one', async () => {
  const { panel, end } = await shown(later, 'late\ntwo\n')
  await pause(200)
  stub.moveCursor(1, 0)
  await stub.until(() => panel.posted.length === 1, 'the panel shows something')
  await pause(1200)
  assert.strictEqual(panel.posted.length, 1)
  assert.strictEqual(last(panel).title, 'two')
  await end()
})

test('the panel is refreshed after each analysis of its program', async () => {
  const { document, panel, end } = await shown(later, 'one\n')
  await stub.until(() => panel.posted.length === 1, 'the panel shows something')
  stub.edit(document, 'one', 'other')
  await stub.until(() => panel.posted.length === 2, 'the panel is refreshed')
  assert.strictEqual(last(panel).title, 'other')
  await end()
})

test('a server that does not know the request is asked once', async () => {
  stub.configure('partc.arguments', ['--quiet'])
  const { panel, end } = await shown(later, 'one\ntwo\n')
  const unknown = { sentence: 'This version of partc cannot show what is at the cursor.' }
  await stub.until(() => panel.posted.length === 1, 'the panel shows something')
  assert.deepStrictEqual(last(panel), unknown)
  stub.moveCursor(1, 0)
  await stub.until(() => panel.posted.length === 2, 'the panel shows something')
  assert.deepStrictEqual(last(panel), unknown)
  assert.strictEqual(stub.log.filter((line) => line.includes('asked')).length, 1)
  assert.deepStrictEqual(stub.messages, [])

  // A server of another version is asked again.
  stub.configure('partc.arguments', [])
  stub.configurationChanged('partc.arguments')
  await stub.until(() => last(panel).title === 'two', 'the panel shows the answer')
  await end()
})

test('the panel shows the answers of the real server', async () => {
  const { document, panel, end } = await shown(partc, fs.readFileSync(path.join(repository, 'examples', 'flange.part'), 'utf8'))
  const { line } = document.positionAt(document.text.indexOf('let lug'))
  stub.moveCursor(line, 'let l'.length)
  await stub.until(() => last(panel)?.title === 'lug', 'the panel shows the function')
  const { rows } = last(panel)
  assert.ok(rows.every((row) => row.length === 2 && row.every((cell) => typeof cell === 'string')))
  const contour = document.positionAt(document.text.indexOf('contour outline'))
  stub.moveCursor(contour.line, 'contour o'.length)
  await stub.until(() => last(panel)?.title === 'outline', 'the panel shows the contour')
  assert.match(last(panel).svg, /<svg/)
  assert.deepStrictEqual(stub.messages, [])
  await end()
})

test('the policy of the page allows no network, no foreign script and no inline style', async () => {
  const { panel, end } = await shown(later, 'one\n')
  const { html, options } = panel.webview
  const [, policy] = /http-equiv="Content-Security-Policy" content="([^"]*)"/.exec(html)
  const [, nonce] = /<script nonce="([^"]*)" src="https:\/\/webview\.test[^"]*\/media\/panel\.js">/.exec(html)
  assert.deepStrictEqual(policy.split('; '), [
    "default-src 'none'",
    'img-src data:',
    'style-src https://webview.test',
    `script-src 'nonce-${nonce}'`,
    "base-uri 'none'",
    "form-action 'none'",
  ])
  assert.strictEqual(html.match(/<script/g).length, 1)
  assert.doesNotMatch(html, /style=|<style|onload|javascript:/)
  assert.deepStrictEqual(options.localResourceRoots.map((uri) => path.basename(uri.path)), ['media'])
  await end()
})

test('the page gets its content again when it becomes visible again', async () => {
  const { panel, end } = await shown(later, 'one\n')
  await stub.until(() => panel.posted.length === 1, 'the panel shows something')
  panel.receive('ready')
  assert.deepStrictEqual(panel.posted[1], panel.posted[0])
  await end()
})

test('the script of the page fills in texts as texts, and a drawing as a picture', () => {
  // As much of a page as the script uses.
  const element = () => ({
    children: [],
    textContent: '',
    appendChild(child) {
      this.children.push(child)
      return child
    },
    replaceChildren(...children) {
      this.children = children
    },
    removeAttribute(name) {
      delete this[name]
    },
  })
  const elements = Object.fromEntries(['sentence', 'title', 'rows', 'picture'].map((id) => [id, element()]))
  const sent = []
  let receive
  vm.runInNewContext(fs.readFileSync(path.join(root, 'media', 'panel.js'), 'utf8'), {
    acquireVsCodeApi: () => ({ postMessage: (message) => sent.push(message) }),
    document: { getElementById: (id) => elements[id], createElement: element },
    window: { addEventListener: (_name, listener) => (receive = listener) },
    encodeURIComponent,
  })
  assert.deepStrictEqual(sent, ['ready'])

  receive({ data: { title: '<b>c</b>', rows: [['radius', '9 mm']], svg: '<svg>#я</svg>' } })
  assert.strictEqual(elements.title.textContent, '<b>c</b>')
  assert.deepStrictEqual([...elements.rows.children[0].children].map((cell) => cell.textContent), ['radius', '9 mm'])
  assert.strictEqual(elements.picture.src, 'data:image/svg+xml;charset=utf-8,%3Csvg%3E%23%D1%8F%3C%2Fsvg%3E')
  assert.strictEqual(elements.picture.hidden, false)

  receive({ data: { sentence: 'nothing' } })
  assert.strictEqual(elements.sentence.textContent, 'nothing')
  assert.strictEqual(elements.title.textContent, '')
  assert.strictEqual(elements.rows.children.length, 0)
  assert.strictEqual(elements.picture.hidden, true)
  assert.strictEqual('src' in elements.picture, false)
})
