// Plays the part of VS Code in the tests: the module `vscode`, as far as the extension and vscode-languageclient use it.
// The object `stub` is not part of VS Code. By it a test acts as the user, and looks at what the extension shows.
const fs = require('fs')
const { URI, Utils } = require('vscode-uri')

// Values ---------------------------------------------------------------------------------------------------------------

class Disposable {
  constructor(callOnDispose) {
    this.callOnDispose = callOnDispose
  }
  static from(...disposables) {
    return new Disposable(() => disposables.forEach((disposable) => disposable.dispose()))
  }
  dispose() {
    this.callOnDispose?.()
    this.callOnDispose = undefined
  }
}

class EventEmitter {
  constructor() {
    this.listeners = new Set()
    this.event = (listener, thisArgs, disposables) => {
      const bound = (value) => listener.call(thisArgs, value)
      this.listeners.add(bound)
      const result = new Disposable(() => this.listeners.delete(bound))
      disposables?.push(result)
      return result
    }
  }
  fire(value) {
    for (const listener of [...this.listeners]) listener(value)
  }
  dispose() {
    this.listeners.clear()
  }
}

class CancellationTokenSource {
  constructor() {
    this.emitter = new EventEmitter()
    this.token = { isCancellationRequested: false, onCancellationRequested: this.emitter.event }
  }
  cancel() {
    this.token.isCancellationRequested = true
    this.emitter.fire()
  }
  dispose() {
    this.emitter.dispose()
  }
}

class Position {
  constructor(line, character) {
    this.line = line
    this.character = character
  }
  compareTo(other) {
    return this.line - other.line || this.character - other.character
  }
  isBefore(other) {
    return this.compareTo(other) < 0
  }
  isEqual(other) {
    return this.compareTo(other) === 0
  }
}

class Range {
  constructor(a, b, c, d) {
    const [first, second] = typeof a === 'number' ? [new Position(a, b), new Position(c, d)] : [a, b]
    this.start = second.isBefore(first) ? second : first
    this.end = second.isBefore(first) ? first : second
  }
  get isEmpty() {
    return this.start.isEqual(this.end)
  }
}

class Selection extends Range {
  constructor(anchor, active) {
    super(anchor, active)
    this.anchor = anchor
    this.active = active
  }
}

// A class whose constructor stores its arguments under these names.
const record = (...names) =>
  class {
    constructor(...values) {
      names.forEach((name, k) => {
        this[name] = values[k]
      })
    }
  }

class DocumentSymbol extends record('name', 'detail', 'kind', 'range', 'selectionRange') {
  children = []
}

class Hover {
  constructor(contents, range) {
    this.contents = Array.isArray(contents) ? contents : [contents]
    this.range = range
  }
}

class MarkdownString {
  constructor(value = '') {
    this.value = value
  }
  appendCodeblock(code, language = '') {
    this.value += `\n\`\`\`${language}\n${code}\n\`\`\`\n`
    return this
  }
}

class CodeActionKind {
  constructor(value) {
    this.value = value
  }
  append(part) {
    return new CodeActionKind(this.value ? `${this.value}.${part}` : part)
  }
  static Empty = new CodeActionKind('')
  static QuickFix = new CodeActionKind('quickfix')
  static Refactor = new CodeActionKind('refactor')
  static RefactorExtract = new CodeActionKind('refactor.extract')
  static RefactorInline = new CodeActionKind('refactor.inline')
  static RefactorRewrite = new CodeActionKind('refactor.rewrite')
  static Source = new CodeActionKind('source')
  static SourceOrganizeImports = new CodeActionKind('source.organizeImports')
}

// An object that numbers these names from `first`.
const enumeration = (first, ...names) => Object.fromEntries(names.map((name, k) => [name, first + k]))

// Texts ----------------------------------------------------------------------------------------------------------------

class TextDocument {
  constructor(uri, languageId, text) {
    Object.assign(this, { uri, languageId, text, version: 1, isClosed: false, isDirty: false, eol: 1 })
    this.fileName = uri.fsPath
    this.isUntitled = uri.scheme === 'untitled'
  }
  get lines() {
    return this.text.split(/\r\n|\r|\n/)
  }
  get lineCount() {
    return this.lines.length
  }
  getText(range) {
    return range ? this.text.slice(this.offsetAt(range.start), this.offsetAt(range.end)) : this.text
  }
  lineAt(line) {
    return { text: this.lines[line], lineNumber: line }
  }
  offsetAt({ line, character }) {
    const starts = [0, ...[...this.text.matchAll(/\r\n|\r|\n/g)].map((found) => found.index + found[0].length)]
    return Math.min((starts[line] ?? this.text.length) + character, this.text.length)
  }
  positionAt(offset) {
    const before = this.text.slice(0, offset).split(/\r\n|\r|\n/)
    return new Position(before.length - 1, before.at(-1).length)
  }
  async save() {
    fs.writeFileSync(this.uri.fsPath, this.text)
    this.isDirty = false
    events.saved.fire(this)
    return true
  }
}

// The state of the window -----------------------------------------------------------------------------------------------

const events = {}
const event = (name) => (events[name] ??= new EventEmitter()).event

const never = () => new Disposable()
const documents = []
const configuration = {}
const commandsByName = new Map()
const providers = {}
const log = []
const messages = []
const panels = []
const tasks = []
const collections = []
let activeTextEditor

const register = (kind) => (selector, provider) => {
  const entry = { selector, provider }
  const all = (providers[kind] ??= new Set())
  all.add(entry)
  return new Disposable(() => all.delete(entry))
}

const show = (severity) => (text, ...items) => {
  messages.push({ severity, text, items: items.filter((item) => typeof item === 'string') })
  return Promise.resolve(stub.answer)
}

function createOutputChannel(name) {
  const append = (text) => log.push(text)
  return { name, append, appendLine: append, replace: append, clear() {}, show() {}, hide() {}, dispose() {} }
}

function createDiagnosticCollection(name) {
  const entries = new Map()
  const collection = {
    name,
    set(uri, diagnostics) {
      entries.set(uri.toString(), diagnostics ?? [])
      events.diagnostics?.fire({ uri, diagnostics })
    },
    get: (uri) => entries.get(uri.toString()),
    delete: (uri) => entries.delete(uri.toString()),
    clear: () => entries.clear(),
    dispose() {
      entries.clear()
      if (collections.includes(collection)) collections.splice(collections.indexOf(collection), 1)
    },
  }
  collections.push(collection)
  return collection
}

function createWebviewPanel(viewType, title, place, options) {
  const disposed = new EventEmitter()
  const received = new EventEmitter()
  const panel = {
    viewType,
    title,
    place,
    posted: [],
    receive: (message) => received.fire(message),
    reveal() {},
    onDidDispose: disposed.event,
    dispose() {
      if (!panels.includes(panel)) return
      panels.splice(panels.indexOf(panel), 1)
      disposed.fire()
    },
    webview: {
      options,
      html: '',
      cspSource: 'https://webview.test',
      asWebviewUri: (uri) => URI.parse(`https://webview.test${uri.path}`),
      onDidReceiveMessage: received.event,
      postMessage: async (message) => {
        panel.posted.push(message)
        events.posted?.fire(message)
        return true
      },
    },
  }
  panels.push(panel)
  return panel
}

function matches(selector, document) {
  const filters = Array.isArray(selector) ? selector : [selector]
  return filters.some((filter) => {
    if (typeof filter === 'string') return filter === document.languageId
    const fits = (wanted, present) => wanted === undefined || wanted === '*' || wanted === present
    return fits(filter.language, document.languageId) && fits(filter.scheme, document.uri.scheme)
  })
}

// The providers of one kind for a document, called as VS Code calls them.
const ask = (kind, method) => async (document, ...parameters) => {
  const token = new CancellationTokenSource().token
  for (const { selector, provider } of providers[kind] ?? []) {
    if (matches(selector, document)) return provider[method](document, ...parameters, token)
  }
  return undefined
}

// What a test may do and see --------------------------------------------------------------------------------------------

const stub = {
  messages,
  panels,
  tasks,
  log,
  collections,
  // What the user answers to messages.
  answer: undefined,

  // Forgets all settings, messages and tasks.
  reset() {
    for (const name of Object.keys(configuration)) delete configuration[name]
    for (const list of [messages, tasks, log]) list.length = 0
    stub.answer = undefined
  },
  configure(name, value) {
    configuration[name] = value
  },
  configurationChanged(name) {
    events.configuration.fire({ affectsConfiguration: (section) => name === section || name.startsWith(`${section}.`) })
  },

  open(file, languageId) {
    const document = new TextDocument(URI.file(file), languageId, fs.readFileSync(file, 'utf8'))
    documents.push(document)
    events.opened?.fire(document)
    activeTextEditor = { document, selection: new Selection(new Position(0, 0), new Position(0, 0)) }
    events.activeEditor?.fire(activeTextEditor)
    return document
  },
  // Replaces the first occurrence of a text, as typing does.
  edit(document, before, after) {
    const offset = document.text.indexOf(before)
    if (offset < 0) throw new Error(`the document has no ‘${before}’`)
    const range = new Range(document.positionAt(offset), document.positionAt(offset + before.length))
    document.text = document.text.slice(0, offset) + after + document.text.slice(offset + before.length)
    document.version += 1
    document.isDirty = true
    const contentChanges = [{ range, rangeOffset: offset, rangeLength: before.length, text: after }]
    events.changed.fire({ document, contentChanges, reason: undefined })
  },
  close(document) {
    documents.splice(documents.indexOf(document), 1)
    document.isClosed = true
    if (activeTextEditor?.document === document) activeTextEditor = undefined
    events.closed.fire(document)
  },
  moveCursor(line, character) {
    const at = new Position(line, character)
    activeTextEditor.selection = new Selection(at, at)
    events.selection.fire({ textEditor: activeTextEditor, selections: [activeTextEditor.selection] })
  },

  diagnostics: (document) => collections.flatMap((collection) => collection.get(document.uri) ?? []),
  hover: ask('hover', 'provideHover'),
  definition: ask('definition', 'provideDefinition'),
  symbols: ask('documentSymbol', 'provideDocumentSymbols'),
  formatting: ask('documentFormatting', 'provideDocumentFormattingEdits'),

  // Waits until a condition holds; fails after some seconds.
  async until(condition, what, timeout = 10000) {
    const end = Date.now() + timeout
    while (!condition()) {
      if (Date.now() > end) throw new Error(`waited in vain until ${what}`)
      await new Promise((resolve) => setTimeout(resolve, 10))
    }
  },

  commands: () => [...commandsByName.keys()],
  extensionContext: (folder) => ({ extensionUri: URI.file(folder), subscriptions: [] }),
}

// The module ------------------------------------------------------------------------------------------------------------

module.exports = {
  stub,
  version: '1.82.0',

  Uri: Object.assign(URI, { joinPath: Utils.joinPath }),
  Disposable,
  EventEmitter,
  CancellationTokenSource,
  CancellationError: class extends Error {},
  Position,
  Range,
  Selection,
  Hover,
  MarkdownString,
  DocumentSymbol,
  CodeActionKind,
  Location: record('uri', 'range'),
  TextEdit: record('range', 'newText'),
  Diagnostic: record('range', 'message', 'severity'),
  DiagnosticRelatedInformation: record('location', 'message'),
  SemanticTokensLegend: record('tokenTypes', 'tokenModifiers'),
  SemanticTokens: record('data', 'resultId'),
  SymbolInformation: record('name', 'kind', 'containerName', 'location'),
  CompletionItem: record('label', 'kind'),
  CodeLens: record('range', 'command'),
  CodeAction: record('title', 'kind'),
  DocumentLink: record('range', 'target'),
  InlayHint: record('position', 'label', 'kind'),
  CallHierarchyItem: record('kind', 'name', 'detail', 'uri', 'range', 'selectionRange'),
  TypeHierarchyItem: record('kind', 'name', 'detail', 'uri', 'range', 'selectionRange'),
  RelativePattern: record('baseUri', 'pattern'),
  TabInputText: record('uri'),
  TabInputTextDiff: record('original', 'modified'),
  TabInputCustom: record('uri', 'viewType'),
  Task: record('definition', 'scope', 'name', 'source', 'execution', 'problemMatchers'),
  ProcessExecution: record('process', 'args', 'options'),

  DiagnosticSeverity: enumeration(0, 'Error', 'Warning', 'Information', 'Hint'),
  DiagnosticTag: enumeration(1, 'Unnecessary', 'Deprecated'),
  CompletionItemKind: enumeration(0, 'Text'),
  SymbolKind: { Property: 6, TypeParameter: 25 },
  FileType: enumeration(1, 'File', 'Directory'),
  TextDocumentSaveReason: enumeration(1, 'Manual', 'AfterDelay', 'FocusOut'),
  ProgressLocation: { SourceControl: 1, Window: 10, Notification: 15 },
  ViewColumn: { Active: -1, Beside: -2 },
  TaskScope: enumeration(1, 'Global', 'Workspace'),

  env: { appName: 'stub', language: 'en', openExternal: async () => true },

  commands: {
    registerCommand(name, run) {
      commandsByName.set(name, run)
      return new Disposable(() => commandsByName.delete(name))
    },
    executeCommand: async (name, ...parameters) => {
      if (commandsByName.has(name)) return commandsByName.get(name)(...parameters)
      messages.push({ severity: 'command', text: [name, ...parameters].join(' '), items: [] })
      return undefined
    },
  },

  window: {
    get activeTextEditor() {
      return activeTextEditor
    },
    tabGroups: { all: [], onDidChangeTabs: event('tabs') },
    onDidChangeActiveTextEditor: event('activeEditor'),
    onDidChangeTextEditorSelection: event('selection'),
    createOutputChannel,
    createWebviewPanel,
    showErrorMessage: show('error'),
    showWarningMessage: show('warning'),
    showInformationMessage: show('information'),
    withProgress: (_options, run) => run({ report() {} }, new CancellationTokenSource().token),
  },

  workspace: {
    get textDocuments() {
      return documents
    },
    workspaceFolders: undefined,
    notebookDocuments: [],
    getWorkspaceFolder: () => undefined,
    getConfiguration: (section) => ({
      get: (name, otherwise) => configuration[section ? `${section}.${name}` : name] ?? otherwise,
    }),
    createFileSystemWatcher: (pattern) => ({
      pattern,
      onDidCreate: never,
      onDidChange: never,
      onDidDelete: never,
      dispose() {},
    }),
    applyEdit: async () => true,
    onDidChangeConfiguration: event('configuration'),
    onDidChangeWorkspaceFolders: event('folders'),
    onDidOpenTextDocument: event('opened'),
    onDidChangeTextDocument: event('changed'),
    onDidCloseTextDocument: event('closed'),
    onDidSaveTextDocument: event('saved'),
    onWillSaveTextDocument: event('willSave'),
    onDidOpenNotebookDocument: never,
    onDidChangeNotebookDocument: never,
    onDidSaveNotebookDocument: never,
    onDidCloseNotebookDocument: never,
    onDidCreateFiles: never,
    onDidRenameFiles: never,
    onDidDeleteFiles: never,
    onWillCreateFiles: never,
    onWillRenameFiles: never,
    onWillDeleteFiles: never,
  },

  languages: {
    match: (selector, document) => (matches(selector, document) ? 10 : 0),
    createDiagnosticCollection,
    registerHoverProvider: register('hover'),
    registerDefinitionProvider: register('definition'),
    registerDocumentSymbolProvider: register('documentSymbol'),
    registerDocumentFormattingEditProvider: register('documentFormatting'),
    registerCompletionItemProvider: register('completion'),
    registerCodeActionsProvider: register('codeAction'),
    registerReferenceProvider: register('reference'),
    registerRenameProvider: register('rename'),
    registerDocumentHighlightProvider: register('highlight'),
    registerSignatureHelpProvider: register('signatureHelp'),
    registerFoldingRangeProvider: register('foldingRange'),
    registerSelectionRangeProvider: register('selectionRange'),
    registerInlayHintsProvider: register('inlayHint'),
    registerCodeLensProvider: register('codeLens'),
    registerDocumentLinkProvider: register('documentLink'),
    registerDocumentSemanticTokensProvider: register('semanticTokens'),
    registerOnTypeFormattingEditProvider: register('onTypeFormatting'),
    registerWorkspaceSymbolProvider: (provider) => register('workspaceSymbol')('*', provider),
  },

  tasks: {
    executeTask: async (task) => {
      tasks.push(task)
      return { task, terminate() {} }
    },
  },
}
