const readonly = (names) => Object.fromEntries(names.split(' ').map((name) => [name, 'readonly']));

const rules = {
  'max-len': ['error', 100],
  'max-lines-per-function': ['error', 40],
  'max-lines': ['error', 600],
  'no-unused-vars': 'error',
  'no-undef': 'error',
  'prefer-const': 'error',
  'no-shadow': 'error',
  eqeqeq: 'error',
};

const browser = readonly('document window fetch EventSource performance requestAnimationFrame '
  + 'ResizeObserver Path2D setTimeout clearTimeout Option matchMedia localStorage getComputedStyle '
  + 'TextDecoder console');
const node = readonly('process Buffer URL setInterval clearInterval setTimeout fetch console '
  + 'performance');

export default [
  { files: ['preview/*.js'], languageOptions: { globals: browser }, rules },
  {
    files: ['test/browser/*.mjs'],
    languageOptions: { globals: { ...browser, ...node } },
    // The tests run functions in the page, where `partc` is a name of the page.
    rules: { ...rules, 'no-undef': 'off', 'max-lines-per-function': 'off' },
  },
];
