// The entry points of the extension: VS Code calls `activate` once, and `deactivate` at the end.
import * as vscode from 'vscode'
import { compile } from './compile'
import { Panel } from './panel'
import { Server } from './server'

let server: Server | undefined

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const running = new Server()
  server = running
  const panel = new Panel(context.extensionUri, running)
  context.subscriptions.push(
    running,
    panel,
    vscode.commands.registerCommand('partc.restart', () => running.restart()),
    vscode.commands.registerCommand('partc.compile', () => compile()),
    vscode.commands.registerCommand('partc.showPicture', () => panel.show()),
    vscode.commands.registerCommand('partc.showPreview', async () => {
      const document = vscode.window.activeTextEditor?.document
      if (document) await running.preview(document)
    }),
    vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => {
      if (textEditor.document.languageId === 'part') running.cursorAt(textEditor.document, textEditor.selection.active)
    }),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      const concerned = ['partc.path', 'partc.arguments'].some((name) => change.affectsConfiguration(name))
      if (concerned && running.isWanted) await running.restart()
    }),
    vscode.workspace.onDidOpenTextDocument(async (document) => {
      if (document.languageId === 'part' && !running.isWanted) await running.restart()
    }),
  )
  // A folder with descriptions or sheets alone needs no server.
  if (vscode.workspace.textDocuments.some((document) => document.languageId === 'part')) await running.restart()
}

export async function deactivate(): Promise<void> {
  await server?.stop()
}
