// The settings of the user.
import * as vscode from 'vscode'

export interface Settings {
  // The program partc: its name on the path, or its location.
  readonly path: string
  // Further arguments of its commands.
  readonly arguments: readonly string[]
}

export function settings(): Settings {
  const section = vscode.workspace.getConfiguration('partc')
  return {
    path: section.get<string>('path', 'partc').trim() || 'partc',
    arguments: section.get<string[]>('arguments', []),
  }
}
