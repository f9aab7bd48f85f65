// The grammar of part programs for tree-sitter. It follows the grammar in docs/language.md.
//
// It accepts every program that `partc` accepts, and some more: it does not require a statement to
// begin on a new line, it does not refuse the words of the language as names, and it accepts chained
// comparisons. `partc` itself reports these mistakes.
//
// src/scanner.c reads the tokens for which the ends of lines matter.

/// <reference types="tree-sitter-cli/dsl" />
// @ts-check

const PRECEDENCE = {
  or: 1,
  and: 2,
  not: 3,
  comparison: 4,
  range: 5,
  sum: 6,
  product: 7,
  sign: 8,
};

const CONSTANTS = ['pi', 'true', 'false'];

const COLUMN_UNITS = ['mm', 'cm', 'm', 'in', 'deg', 'rad'];

const OTHER_UNITS = ['mm/min', 'm/min', 'in/min', 'ft/min', 'rpm'];

// One or more of a rule, with commas between them.
function list(rule) {
  return seq(rule, repeat(seq(',', rule)));
}

module.exports = grammar({
  name: 'part',

  word: $ => $.name,

  extras: $ => [/\s/, $.comment],

  externals: $ => [
    // the end of a line of a table
    $._row_end,
    // `rapid` and `feed` on the line of the point before them
    $._rapid_here,
    $._feed_here,
    // `from` on the line of the region before it
    $._from_here,
    // nothing, where more text follows on the line
    $._same_line,
    // valid only while tree-sitter recovers from an error
    $._recovery,
  ],

  supertypes: $ => [$._statement, $._item, $._setting, $._expression],

  rules: {
    program: $ => repeat($._statement),

    // Statements

    _statement: $ => choice(
      $.part, $.units, $.machine, $.import, $.tool, $.feed, $.tolerance, $.clearance, $.from,
      $.work, $.program_number, $.safe, $.stock, $.avoid,
      $.let, $.param, $.table, $.curve, $.piece, $.contour, $.drawn_contour, $.drawn_contours, $.assert,
      $.mill, $.turn, $.pocket, $.rest_of, $.face, $.engrave, $.vcarve, $.drill, $.hole, $.rapid, $.move,
      $.change, $.spindle, $.coolant, $.aux, $.program_stop, $.optional_stop, $.dwell,
      $.for, $.if, $.with,
    ),

    statements: $ => seq('{', repeat($._statement), '}'),

    part: $ => seq('part', field('name', $.name), optional(field('title', $.text))),
    units: $ => seq('units', field('unit', alias(choice('mm', 'in'), $.unit))),
    machine: $ => seq('machine', field('name', choice($.machine_name, $.text))),
    import: $ => seq('import', field('file', $.text)),
    tool: $ => seq('tool', optional(choice($.number, $.name)), $._cutter),
    feed: $ => seq('feed', $._expression),
    tolerance: $ => seq(
      'tolerance',
      choice($._expression, seq('inside', $._expression, 'outside', $._expression)),
    ),
    clearance: $ => seq('clearance', $._expression),
    from: $ => seq('from', $._expression),
    work: $ => seq('work', $._expression),
    program_number: $ => seq('program', $._expression),
    safe: $ => seq('safe', $._expression),
    stock: $ => seq('stock', field('region', $._expression), optional($._heights)),
    avoid: $ => seq('avoid', field('region', $._expression), optional($._heights)),
    _heights: $ => seq(
      alias($._from_here, 'from'), field('bottom', $._expression),
      'to', field('top', $._expression),
    ),

    let: $ => seq(
      'let',
      field('name', $.name),
      optional(field('parameters', $.parameters)),
      '=',
      field('value', $._expression),
    ),
    parameters: $ => seq(token.immediate('('), list($.name), ')'),
    param: $ => seq('param', field('name', $.name), '=', field('value', $._expression)),

    table: $ => seq(
      'table',
      field('name', $.name),
      choice(seq('from', $._drawing), field('rows', $.rows)),
    ),
    rows: $ => seq('{', repeat(choice($.headings, $.row)), '}'),
    headings: $ => seq(repeat1($.heading), $._row_end),
    heading: $ => seq(
      field('name', $.name),
      optional(field('unit', alias(choice(...COLUMN_UNITS), $.unit))),
    ),
    row: $ => seq(repeat1(field('cell', $._cell)), $._row_end),
    _cell: $ => choice(
      $.quantity,
      alias($.negative_quantity, $.sign),
      alias($.bracketed, $.group),
      $.text,
    ),
    negative_quantity: $ => seq('-', $.quantity),
    bracketed: $ => seq('(', $._expression, ')'),

    curve: $ => seq('curve', field('name', $.name), '=', field('value', $._expression)),

    piece: $ => seq(
      'piece',
      field('name', $.name),
      '=',
      field('curve', $._expression),
      optional(seq('cipher', list($.cipher))),
      choice('left', 'right'),
      repeat($.joggle),
    ),
    cipher: $ => seq(field('number', $.number), token.immediate('('), list($._expression), ')'),
    joggle: $ => seq(
      'joggle',
      'from', $._expression,
      'to', $._expression,
      'depth', $._expression,
      'radius', $._expression,
    ),

    assert: $ => seq('assert', $._expression, optional(seq('within', $._expression))),

    mill: $ => seq('mill', field('contour', $._expression), $._side, $.settings),
    turn: $ => seq('turn', field('contour', $._expression), $._side, $.settings),
    pocket: $ => seq(
      'pocket',
      field('contour', $._expression),
      'step', $._expression,
      optional(seq('as', field('name', $.name))),
      $.settings,
    ),
    rest_of: $ => seq(
      'rest', 'of',
      field('clearing', $._expression),
      'step', $._expression,
      $.settings,
    ),
    face: $ => seq(
      'face',
      field('contour', $._expression),
      'step', $._expression,
      $.settings,
    ),
    engrave: $ => seq('engrave', $._lettering, $.settings),
    _lettering: $ => prec.right(seq(
      $.text, 'at', $._expression, 'height', $._expression,
      optional(choice(
        seq('direction', $._expression),
        seq('around', $._expression, optional(choice('inside', 'outside'))),
      )),
      optional(seq('align', choice('left', 'centre', 'right'))),
    )),
    vcarve: $ => seq(
      'vcarve',
      field('region', $._expression),
      optional(seq('as', field('name', $.name))),
      $.settings,
    ),
    drill: $ => seq('drill', 'at', $._expression, 'depth', $._expression, optional($.settings)),
    hole: $ => seq(
      choice(
        seq('spot', 'at', $._expression, choice('depth', 'diameter'), $._expression),
        seq('ream', 'at', $._expression, 'depth', $._expression),
        seq('countersink', 'at', $._expression, 'angle', $._expression, 'diameter', $._expression),
        seq('counterbore', 'at', $._expression, 'diameter', $._expression, 'depth', $._expression),
        seq(
          'bore', 'at', $._expression,
          'diameter', $._expression, 'depth', $._expression, 'pitch', $._expression,
        ),
        seq('tap', 'at', $._expression, 'pitch', $._expression, 'depth', $._expression),
        seq(
          'thread', 'at', $._expression,
          'diameter', $._expression, 'pitch', $._expression, 'depth', $._expression,
          choice('inside', 'outside'),
        ),
      ),
      optional($.settings),
    ),
    rapid: $ => seq('rapid', $._stops),
    move: $ => seq('move', $._stops),
    change: $ => seq('change', $._expression, $._cutter, optional(seq('at', $._expression))),
    spindle: $ => seq('spindle', choice('off', 'manual', seq($._sense, optional(seq($._same_line, $._expression, optional(seq('limit', $._expression))))))),
    coolant: $ => seq('coolant', choice('on', 'off')),
    aux: $ => seq('aux', $._expression),
    program_stop: _ => 'stop',
    optional_stop: _ => seq('optional', 'stop'),
    dwell: $ => seq('dwell', $._expression, 's'),

    for: $ => seq(
      'for',
      field('name', $.name),
      'in',
      field('list', $._expression),
      field('body', $.statements),
    ),
    if: $ => seq(
      'if',
      field('condition', $._expression),
      field('then', $.statements),
      optional(seq('else', field('else', choice($.if, $.statements)))),
    ),
    with: $ => seq('with', $._expression, field('body', $.statements)),

    _cutter: $ => choice(
      $.upright_cutter,
      $.thread_mill,
      $.turning_cutter,
      $.cone,
      $.vbit,
      $.blade,
    ),
    upright_cutter: $ => seq(
      choice('mill', 'drill', 'tap'),
      '(',
      'diameter', $._expression,
      repeat(seq(',', choice($.flutes, $.stickout, $.holder, $.point_angle))),
      ')',
    ),
    thread_mill: $ => seq(
      'threadmill',
      '(',
      'diameter', $._expression, ',',
      'pitch', $._expression,
      repeat(seq(',', choice($.flutes, $.stickout, $.holder))),
      ')',
    ),
    point_angle: $ => seq('angle', $._expression),
    flutes: $ => seq('flutes', $._expression),
    stickout: $ => seq('stickout', $._expression),
    holder: $ => seq(
      'holder', field('diameter', $._expression),
      optional(seq('height', field('height', $._expression))),
    ),
    turning_cutter: $ => seq(
      'turn', '(', 'nose', $._expression, optional(seq(',', 'tip', $._expression)), ')',
    ),
    cone: $ => seq(
      'cone',
      '(',
      'diameter', $._expression, ',',
      'bevel', $._expression, ',',
      'height', $._expression,
      ')',
    ),
    vbit: $ => seq(
      'vbit',
      '(',
      'angle', $._expression, ',',
      'tip', $._expression, ',',
      'diameter', $._expression,
      ')',
    ),
    blade: $ => seq('blade', '(', 'diameter', $._expression, ',', 'gear', $._expression, ')'),

    _side: $ => choice('outside', 'inside', 'left', 'right', 'on'),
    _sense: $ => choice('cw', 'ccw'),

    // Contours

    contour: $ => seq(
      'contour',
      field('name', $.name),
      choice('closed', 'open'),
      field('items', $.items),
    ),
    drawn_contour: $ => seq('contour', field('name', $.name), 'from', $._drawing),
    drawn_contours: $ => seq(
      'contours',
      field('name', $.name),
      'from',
      choice($._drawing, seq(field('file', $.text), 'text', $._lettering)),
    ),
    _drawing: $ => prec.right(seq(
      field('file', $.text),
      optional(seq(choice('layer', 'id', 'class'), $.text)),
      optional(seq('unit', choice('mm', 'in'))),
      optional(seq('within', $.quantity)),
    )),
    items: $ => seq('{', repeat($._item), '}'),
    _item: $ => choice(alias($.for_items, $.for), alias($.if_items, $.if), $.element),
    for_items: $ => seq(
      'for',
      field('name', $.name),
      'in',
      field('list', $._expression),
      field('body', $.items),
    ),
    if_items: $ => seq(
      'if',
      field('condition', $._expression),
      field('then', $.items),
      optional(seq('else', field('else', choice(alias($.if_items, $.if), $.items)))),
    ),
    element: $ => seq(
      optional($._sense),
      $._expression,
      repeat($.modifier),
      optional($.link),
    ),
    modifier: $ => choice(
      seq('feed', $._expression),
      'slow',
      seq('allowance', $._expression),
      seq('bevel', $._expression),
    ),
    link: $ => choice(
      seq('meet', optional(seq('near', $._expression))),
      'smooth',
      'tangent',
      seq('fillet', optional('+'), $._expression),
      seq('chamfer', $._expression),
    ),

    // Settings of machining statements

    settings: $ => seq('{', repeat($._setting), '}'),
    _setting: $ => choice(
      $.approach, $.retract, $.depth, $.lead, $.allowance, $.corners, $.climb, $.conventional,
      $.compensation, $.start, $.plunge, $.ramp, $.helix, $.spiral, $.tabs, $.peck,
      $.chip_break, alias($.dwell, $.pause), $.pitch, $.hand, $.floating, $.shortest, $.islands, $.rest, $.angle,
    ),
    approach: $ => seq('approach', $._stops),
    retract: $ => seq('retract', $._stops),
    depth: $ => seq('depth', $._expression, optional(seq('step', $._expression))),
    lead: $ => seq('lead', choice('in', 'out'), choice('line', 'arc'), $._expression),
    allowance: $ => seq('allowance', list($._expression)),
    corners: $ => seq('corners', choice('round', 'sharp')),
    climb: _ => 'climb',
    shortest: _ => 'shortest',
    conventional: _ => 'conventional',
    compensation: $ => seq('compensation', choice('compiler', 'controller')),
    start: $ => seq('start', 'near', $._expression),
    plunge: $ => seq('plunge', $._expression),
    ramp: $ => seq('ramp', $._expression),
    helix: $ => seq('helix', 'pitch', $._expression, optional(seq('diameter', $._expression))),
    spiral: _ => 'spiral',
    tabs: $ => prec.right(seq(
      choice(
        seq('tabs', $._expression),
        seq('tab', 'at', $._expression, repeat(seq(',', $._expression))),
      ),
      'width', $._expression, 'height', $._expression, optional(seq('angle', $._expression)),
    )),
    peck: $ => seq('peck', $._expression),
    chip_break: $ => seq('chip', 'break', $._expression),
    pitch: $ => seq('pitch', $._expression),
    hand: $ => seq('hand', choice('left', 'right')),
    floating: _ => 'floating',
    islands: $ => seq('islands', list($._expression)),
    rest: $ => seq('rest', 'allowed'),
    angle: $ => seq('angle', $._expression),

    _stops: $ => list($.stop),
    stop: $ => seq(
      $._expression,
      optional(choice(
        alias($._rapid_here, 'rapid'),
        seq(alias($._feed_here, 'feed'), $._expression),
      )),
    ),

    // Expressions

    _expression: $ => choice(
      $.conditional, $.binary, $.not, $.range, $.sign,
      $.quantity, $.constant, $.name, $.call, $.group, $.point, $.list, $.comprehension,
    ),
    conditional: $ => seq(
      'if', field('condition', $._expression),
      'then', field('then', $._expression),
      'else', field('else', $._expression),
    ),
    binary: $ => {
      const levels = [
        [PRECEDENCE.or, 'or'],
        [PRECEDENCE.and, 'and'],
        [PRECEDENCE.comparison, choice('<', '<=', '>', '>=', '=', '!=')],
        [PRECEDENCE.sum, choice('+', '-')],
        [PRECEDENCE.product, choice('*', '/')],
      ];
      return choice(...levels.map(([level, sign]) => prec.left(level, seq(
        field('left', $._expression),
        field('operator', sign),
        field('right', $._expression),
      ))));
    },
    not: $ => prec(PRECEDENCE.not, seq('not', $._expression)),
    range: $ => prec.right(PRECEDENCE.range, seq(
      field('first', $._expression),
      '..',
      field('last', $._expression),
      optional(seq('by', field('step', $._expression))),
    )),
    sign: $ => prec(PRECEDENCE.sign, seq('-', $._expression)),

    quantity: $ => seq($.number, optional($.unit)),
    unit: _ => choice(...COLUMN_UNITS, ...OTHER_UNITS),
    constant: _ => choice(...CONSTANTS),
    call: $ => seq(field('function', choice($.name, $.constant)), $.arguments),
    arguments: $ => seq(token.immediate('('), list($._argument), ')'),
    _argument: $ => choice($._expression, $.choice),
    choice: $ => choice(
      seq(choice('near', 'left', 'right', 'inside', 'outside', 'within'), $._expression),
      'first',
      'last',
    ),
    group: $ => seq('(', $._expression, ')'),
    point: $ => seq(
      '(', $._expression, ',', $._expression, optional(seq(',', $._expression)), ')',
    ),
    list: $ => seq('[', optional(list($._expression)), ']'),
    comprehension: $ => seq(
      '[',
      field('value', $._expression),
      'for',
      field('name', $.name),
      'in',
      field('list', $._expression),
      ']',
    ),

    // Tokens

    name: _ => /[\p{L}_][\p{L}\p{N}_]*/,
    machine_name: _ => /\p{L}[\p{L}\p{N}.]*(-[\p{L}\p{N}.]+)*/,
    number: _ => /[0-9]+(\.[0-9]+)?/,
    text: _ => /"[^"\r\n]*"/,
    comment: _ => token(/--[^\r\n]*/),
  },
});
