// Loads the compiled extension with the stub in the place of VS Code.
const fs = require('fs')
const Module = require('module')
const { after } = require('node:test')
const os = require('os')
const path = require('path')

const root = path.join(__dirname, '..')
const stubFile = path.join(__dirname, 'vscode-stub', 'index.js')

const resolve = Module._resolveFilename
Module._resolveFilename = (request, ...rest) => (request === 'vscode' ? stubFile : resolve(request, ...rest))

const vscode = require('vscode')
const extension = require(path.join(root, 'out', 'extension.js'))

// A server that a failed test has left behind must not keep the tests from ending.
after(() => setTimeout(() => process.exit(1), 2000).unref())

// The ids of the processes that this process has started and that still run.
function children() {
  return fs
    .readdirSync('/proc/self/task')
    .flatMap((task) => fs.readFileSync(`/proc/self/task/${task}/children`, 'utf8').split(' '))
    .filter((id) => id !== '')
}

// A new folder with a file; its path.
function temporary(name, text) {
  const file = path.join(fs.mkdtempSync(path.join(os.tmpdir(), 'partc-vscode-')), name)
  fs.writeFileSync(file, text)
  return file
}

async function activate() {
  const context = vscode.stub.extensionContext(root)
  await extension.activate(context)
  return context
}

// Ends the extension as VS Code does.
async function deactivate(context) {
  await extension.deactivate()
  for (const subscription of context.subscriptions.reverse()) subscription.dispose()
}

module.exports = {
  root,
  repository: path.join(root, '..', '..'),
  partc: process.env.PARTC || 'partc',
  vscode,
  stub: vscode.stub,
  activate,
  deactivate,
  children,
  temporary,
}
