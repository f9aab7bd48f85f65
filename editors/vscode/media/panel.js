// Fills the page of the panel with each message of the extension: a sentence, or a title with rows and a drawing.
const host = acquireVsCodeApi()
const element = (id) => document.getElementById(id)

window.addEventListener('message', ({ data }) => {
  element('sentence').textContent = data.sentence ?? ''
  element('title').textContent = data.title ?? ''
  element('rows').replaceChildren(
    ...(data.rows ?? []).map(([name, value]) => {
      const row = document.createElement('tr')
      for (const text of [name, value]) row.appendChild(document.createElement('td')).textContent = text
      return row
    }),
  )
  const picture = element('picture')
  picture.hidden = !data.svg
  picture.alt = data.title ?? ''
  if (data.svg) picture.src = 'data:image/svg+xml;charset=utf-8,' + encodeURIComponent(data.svg)
  else picture.removeAttribute('src')
})

host.postMessage('ready')
