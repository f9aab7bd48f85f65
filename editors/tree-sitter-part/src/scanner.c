// The tokens for which the ends of lines matter. No state is kept between them.

#include "tree_sitter/parser.h"

// In the order of `externals` in grammar.js.
enum TokenType { ROW_END, RAPID_HERE, FEED_HERE, FROM_HERE, SAME_LINE, RECOVERY };

void *tree_sitter_part_external_scanner_create(void) { return NULL; }

void tree_sitter_part_external_scanner_destroy(void *payload) { (void)payload; }

unsigned tree_sitter_part_external_scanner_serialize(void *payload, char *buffer) {
  (void)payload;
  (void)buffer;
  return 0;
}

void tree_sitter_part_external_scanner_deserialize(void *payload, const char *buffer, unsigned length) {
  (void)payload;
  (void)buffer;
  (void)length;
}

// True if the character can continue a name. Every letter outside ASCII counts.
static bool continues_name(int32_t c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c > 127;
}

// Reads a word and nothing that continues it.
static bool read_word(TSLexer *lexer, const char *word) {
  for (; *word; word++) {
    if (lexer->lookahead != *word) return false;
    lexer->advance(lexer, false);
  }
  lexer->mark_end(lexer);
  return !continues_name(lexer->lookahead);
}

bool tree_sitter_part_external_scanner_scan(void *payload, TSLexer *lexer, const bool *valid) {
  (void)payload;
  if (valid[RECOVERY]) return false;

  while (lexer->lookahead == ' ' || lexer->lookahead == '\t') lexer->advance(lexer, true);

  lexer->mark_end(lexer);
  bool line_ends = lexer->lookahead == '\n' || lexer->lookahead == '\r' || lexer->lookahead == '}' || lexer->eof(lexer);

  // These two tokens have no characters.
  if (valid[ROW_END]) {
    lexer->result_symbol = ROW_END;
    return line_ends;
  }
  if (valid[SAME_LINE]) {
    lexer->result_symbol = SAME_LINE;
    if (line_ends) return false;
    if (lexer->lookahead != '-') return true;
    lexer->advance(lexer, false);
    return lexer->lookahead != '-';
  }

  if (valid[RAPID_HERE] && lexer->lookahead == 'r') {
    lexer->result_symbol = RAPID_HERE;
    return read_word(lexer, "rapid");
  }
  if (valid[FEED_HERE] && lexer->lookahead == 'f') {
    lexer->result_symbol = FEED_HERE;
    return read_word(lexer, "feed");
  }
  if (valid[FROM_HERE] && lexer->lookahead == 'f') {
    lexer->result_symbol = FROM_HERE;
    return read_word(lexer, "from");
  }
  return false;
}
