#!/usr/bin/env node
// Plays the part of a later `partc`, whose server answers the request partc/at and sends partc/settled. The answer is about
// the word at the position; the word `nothing` has no answer, and the word `late` has one after a second. With the argument
// --quiet the server does not know the request, and writes into the log of the editor that it was asked.
const rpc = require('vscode-languageserver-protocol/node')

if (process.argv.includes('--help')) {
  console.log('Usage: partc lsp')
  process.exit(0)
}

const connection = rpc.createProtocolConnection(process.stdin, process.stdout)
let text = ''
let count = 0

connection.onRequest('initialize', () => ({ capabilities: { textDocumentSync: 1 } }))
connection.onRequest('shutdown', () => null)
connection.onNotification('exit', () => process.exit(0))
connection.onNotification('textDocument/didOpen', ({ textDocument }) => {
  text = textDocument.text
})
connection.onNotification('textDocument/didChange', ({ textDocument, contentChanges }) => {
  text = contentChanges.at(-1).text
  connection.sendNotification('partc/settled', { uri: textDocument.uri, version: textDocument.version })
})
connection.onRequest('partc/at', async ({ textDocument, position }) => {
  count += 1
  if (process.argv.includes('--quiet')) {
    connection.sendNotification('window/logMessage', { type: 1, message: 'asked' })
    return new rpc.ResponseError(rpc.ErrorCodes.MethodNotFound, 'there is no request partc/at')
  }
  const word = text.split('\n')[position.line].split(' ')[0]
  if (word === 'nothing') return null
  if (word === 'late') await new Promise((resolve) => setTimeout(resolve, 1000))
  return { title: word, rows: [['question', String(count)]], svg: word === 'drawn' ? '<svg>#1</svg>' : undefined }
})
connection.listen()
