// The command that compiles the program in the active editor. Its reports become problems by the problem matcher $partc.
import * as path from 'path'
import * as vscode from 'vscode'
import { settings } from './settings'

const languages = ['part', 'partc-sheet']

export async function compile(): Promise<void> {
  const document = vscode.window.activeTextEditor?.document
  if (!document || !languages.includes(document.languageId) || document.uri.scheme !== 'file') {
    void vscode.window.showInformationMessage('Open a part program or an input sheet to compile it.')
    return
  }
  if (document.isDirty && !(await document.save())) return
  const file = document.uri.fsPath
  const { path: program, arguments: further } = settings()
  const task = new vscode.Task(
    { type: 'partc', file },
    vscode.TaskScope.Workspace,
    `compile ${path.basename(file)}`,
    'partc',
    new vscode.ProcessExecution(program, ['compile', '--format', 'short', ...further, '--', file], {
      cwd: path.dirname(file),
    }),
    '$partc',
  )
  task.presentationOptions = { clear: true, showReuseMessage: false }
  await vscode.tasks.executeTask(task)
}
