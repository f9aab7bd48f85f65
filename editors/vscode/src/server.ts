// The language server `partc lsp`: its start, restart and end, and the two messages beyond the Language Server Protocol
// that the panel uses.
import { execFile } from 'child_process'
import * as vscode from 'vscode'
import { LanguageClient, ResponseError, type LanguageClientOptions } from 'vscode-languageclient/node'
import { settings, type Settings } from './settings'

// The answer to the request partc/at: a title, rows of a table, and the text of a drawing.
export interface At {
  title: string
  rows: [string, string][]
  svg?: string
}

// An answer to the request partc/at. The server is absent if it does not run, or if it does not know the request.
export type Answer = { kind: 'at'; at: At } | { kind: 'nothing' } | { kind: 'absent' } | { kind: 'unknown' }

// The code of JSON-RPC for a method that the server does not know.
const methodNotFound = -32601

export class Server implements vscode.Disposable {
  // True after the first start, also if the start failed.
  isWanted = false

  private readonly log = vscode.window.createOutputChannel('partc')
  private readonly settled = new vscode.EventEmitter<string>()
  private readonly started = new vscode.EventEmitter<void>()
  private client: LanguageClient | undefined
  // True if this server has refused partc/at as unknown.
  private isAtUnknown = false
  // Starts and stops, one after the other.
  private queue: Promise<void> = Promise.resolve()

  // The address of a document whose analysis is finished.
  readonly onSettled = this.settled.event
  // A server has started, perhaps of another version.
  readonly onStarted = this.started.event

  restart(): Promise<void> {
    this.isWanted = true
    return this.enqueue(async () => {
      await this.stopNow()
      await this.startNow()
    })
  }

  stop(): Promise<void> {
    return this.enqueue(() => this.stopNow())
  }

  dispose(): void {
    this.settled.dispose()
    this.started.dispose()
    this.log.dispose()
  }

  // Asks what is at a position of a document.
  async at(document: vscode.TextDocument, position: vscode.Position): Promise<Answer> {
    const client = this.client
    if (!client) return { kind: 'absent' }
    if (this.isAtUnknown) return { kind: 'unknown' }
    try {
      const at = await client.sendRequest<At | null>('partc/at', {
        textDocument: client.code2ProtocolConverter.asTextDocumentIdentifier(document),
        position: client.code2ProtocolConverter.asPosition(position),
      })
      return at ? { kind: 'at', at } : { kind: 'nothing' }
    } catch (failure) {
      if (failure instanceof ResponseError && failure.code === methodNotFound) {
        if (client === this.client) this.isAtUnknown = true
        return { kind: 'unknown' }
      }
      this.log.appendLine(`partc/at: ${failure}`)
      return client === this.client ? { kind: 'nothing' } : { kind: 'absent' }
    }
  }

  // Lets the server serve the page of the preview for a document. The server then asks VS Code to open it in the browser.
  async preview(document: vscode.TextDocument): Promise<void> {
    const client = this.client
    if (!client?.isRunning()) {
      void vscode.window.showInformationMessage('partc does not run, so there is no preview.')
      return
    }
    try {
      await client.sendRequest('workspace/executeCommand', {
        command: 'partc.preview',
        arguments: [client.code2ProtocolConverter.asUri(document.uri)],
      })
    } catch (failure) {
      this.log.appendLine(`partc.preview: ${failure}`)
      void vscode.window.showErrorMessage('This version of partc has no preview.')
    }
  }

  // Tells the pages of the preview where the cursor is.
  cursorAt(document: vscode.TextDocument, position: vscode.Position): void {
    const client = this.client
    if (!client?.isRunning()) return
    // The server may end at this moment.
    client
      .sendNotification('partc/cursor', {
        textDocument: client.code2ProtocolConverter.asTextDocumentIdentifier(document),
        position: client.code2ProtocolConverter.asPosition(position),
      })
      .catch(() => undefined)
  }

  private enqueue(task: () => Promise<void>): Promise<void> {
    this.queue = this.queue.then(task).catch((failure) => this.log.appendLine(String(failure)))
    return this.queue
  }

  private async startNow(): Promise<void> {
    const wanted = settings()
    const fault = await faultOf(wanted)
    if (fault) {
      // Not awaited: the message stays until the user answers it.
      void report(fault)
      return
    }
    const command = { command: wanted.path, args: ['lsp', ...wanted.arguments] }
    const client = new LanguageClient('partc', 'partc', command, this.options())
    client.onNotification('partc/settled', ({ uri }: { uri: string }) =>
      this.settled.fire(client.protocol2CodeConverter.asUri(uri).toString()),
    )
    this.isAtUnknown = false
    this.client = client
    await client.start()
    this.started.fire()
  }

  private async stopNow(): Promise<void> {
    const client = this.client
    this.client = undefined
    // A client that failed to start cannot be stopped.
    if (client?.needsStop()) await client.dispose()
  }

  private options(): LanguageClientOptions {
    return {
      documentSelector: [
        { scheme: 'file', language: 'part' },
        { scheme: 'untitled', language: 'part' },
        { scheme: 'file', language: 'partc-machine' },
        { scheme: 'file', language: 'partc-sheet' },
      ],
      // The problem matcher has the same name, so that a report of `partc compile` replaces that of the server.
      diagnosticCollectionName: 'partc',
      outputChannel: this.log,
      // Files that a program may import or name.
      synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher('**/*.{part,csv,machine}') },
    }
  }
}

// Tries if the server would start: asks it for its help, with the arguments of the user. Without this test,
// vscode-languageclient would start a server that ends at once five times, with several messages for each time. The result
// is a sentence for the user, or nothing if the server would start.
function faultOf({ path, arguments: further }: Settings): Promise<string | undefined> {
  return new Promise((resolve) => {
    execFile(path, ['lsp', ...further, '--help'], { timeout: 10000 }, (failure, stdout, stderr) => {
      const reason = (stderr || failure?.message || '').split('\n')[0].trim()
      if ((failure as NodeJS.ErrnoException | null)?.code === 'ENOENT')
        resolve(`There is no program "${path}". Install partc, or write its location into the setting partc.path.`)
      else if (failure)
        resolve(`partc does not start (${reason}). Correct the setting partc.path or partc.arguments.`)
      else if (!stdout.includes('partc lsp')) resolve(`"${path}" is not partc. Correct the setting partc.path.`)
      else resolve(undefined)
    })
  })
}

async function report(fault: string): Promise<void> {
  const open = 'Open Settings'
  const chosen = await vscode.window.showErrorMessage(fault, open)
  if (chosen === open) await vscode.commands.executeCommand('workbench.action.openSettings', 'partc')
}
