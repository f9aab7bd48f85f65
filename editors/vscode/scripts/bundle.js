// Bundles the extension and the libraries that it uses into out/extension.js, and collects the licences of these
// libraries in out/licences.txt.
const esbuild = require('esbuild')
const fs = require('fs')
const path = require('path')

process.chdir(path.join(__dirname, '..'))

const { metafile } = esbuild.buildSync({
  entryPoints: ['src/extension.ts'],
  outfile: 'out/extension.js',
  bundle: true,
  external: ['vscode'],
  platform: 'node',
  format: 'cjs',
  target: 'node18',
  metafile: true,
})

const folders = new Set()
for (const file of Object.keys(metafile.inputs)) {
  const found = /^.*node_modules\/(@[^/]+\/)?[^/]+/.exec(file)
  if (found) folders.add(found[0])
}

const licences = [...folders].sort().map((folder) => {
  const { name, version } = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'))
  const file = fs.readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry))
  if (!file) throw new Error(`${folder} has no file with its licence`)
  return `${name} ${version}\n\n${fs.readFileSync(path.join(folder, file), 'utf8').trim()}\n`
})
fs.writeFileSync('out/licences.txt', licences.join(`\n${'-'.repeat(80)}\n\n`))
