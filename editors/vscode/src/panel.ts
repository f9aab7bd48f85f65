// The panel beside the program: it follows the cursor and shows what the server says about the text there.
import { randomBytes } from 'crypto'
import * as vscode from 'vscode'
import type { Answer, At, Server } from './server'

// The time in ms without a movement of the cursor, after which the server is asked.
const delay = 100

// What the page of the panel gets: what is at the cursor, or a sentence.
type Content = At | { sentence: string }

export class Panel implements vscode.Disposable {
  private panel: vscode.WebviewPanel | undefined
  private content: Content = { sentence: 'Put the cursor into a part program.' }
  private timer: NodeJS.Timeout | undefined
  // The count of questions, by which a late answer is recognised.
  private asked = 0
  private readonly subscriptions: vscode.Disposable[]

  constructor(
    private readonly extension: vscode.Uri,
    private readonly server: Server,
  ) {
    this.subscriptions = [
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => {
        if (textEditor === vscode.window.activeTextEditor) this.refreshSoon()
      }),
      vscode.window.onDidChangeActiveTextEditor(() => this.refreshSoon()),
      server.onStarted(() => this.refreshSoon()),
      server.onSettled((uri) => {
        if (program()?.document.uri.toString() === uri) this.refreshSoon()
      }),
    ]
  }

  show(): void {
    if (this.panel) {
      this.panel.reveal(undefined, true)
    } else {
      const media = vscode.Uri.joinPath(this.extension, 'media')
      this.panel = vscode.window.createWebviewPanel(
        'partc.picture',
        'partc',
        { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
        { enableScripts: true, localResourceRoots: [media] },
      )
      this.panel.onDidDispose(() => {
        this.panel = undefined
        clearTimeout(this.timer)
      })
      // The page says when it can receive messages: after each time that it becomes visible.
      this.panel.webview.onDidReceiveMessage(() => this.post())
      this.panel.webview.html = page(this.panel.webview, media)
    }
    this.refreshSoon()
  }

  dispose(): void {
    clearTimeout(this.timer)
    this.panel?.dispose()
    for (const subscription of this.subscriptions) subscription.dispose()
  }

  private refreshSoon(): void {
    if (!this.panel) return
    clearTimeout(this.timer)
    this.timer = setTimeout(() => void this.refresh(), delay)
  }

  private async refresh(): Promise<void> {
    const editor = program()
    // In another editor, or in none, the panel keeps what it shows.
    if (!editor || !this.panel) return
    const question = ++this.asked
    const answer = await this.server.at(editor.document, editor.selection.active)
    if (question !== this.asked) return
    this.content = contentOf(answer)
    this.post()
  }

  private post(): void {
    void this.panel?.webview.postMessage(this.content)
  }
}

// The active editor, if it shows a part program.
function program(): vscode.TextEditor | undefined {
  const editor = vscode.window.activeTextEditor
  return editor?.document.languageId === 'part' ? editor : undefined
}

function contentOf(answer: Answer): Content {
  switch (answer.kind) {
    case 'at':
      return answer.at
    case 'nothing':
      return { sentence: 'There is nothing to show at the cursor.' }
    case 'absent':
      return { sentence: 'partc does not run.' }
    case 'unknown':
      return { sentence: 'This version of partc cannot show what is at the cursor.' }
  }
}

// The page. Its policy allows one script and one style sheet, both of the extension, and pictures that are part of the
// page itself; nothing comes from the network. A drawing is shown as a picture, so scripts in it do not run.
function page(webview: vscode.Webview, media: vscode.Uri): string {
  const script = webview.asWebviewUri(vscode.Uri.joinPath(media, 'panel.js'))
  const style = webview.asWebviewUri(vscode.Uri.joinPath(media, 'panel.css'))
  const nonce = randomBytes(16).toString('base64')
  const policy = [
    "default-src 'none'",
    'img-src data:',
    `style-src ${webview.cspSource}`,
    `script-src 'nonce-${nonce}'`,
    "base-uri 'none'",
    "form-action 'none'",
  ].join('; ')
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="UTF-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="stylesheet" href="${style}">
<title>partc</title>
</head>
<body>
<p id="sentence"></p>
<h1 id="title"></h1>
<table id="rows"></table>
<img id="picture" alt="" hidden>
<script nonce="${nonce}" src="${script}"></script>
</body>
</html>
`
}
