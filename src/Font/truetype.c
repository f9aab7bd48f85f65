/* The glyphs of a text from a TrueType or OpenType font, by FreeType.
 *
 * Everything is in the units of the font: nothing is scaled and nothing is hinted. There is no
 * global state: each call makes a FreeType library of its own, whose memory is counted and limited.
 * FreeType's settings from the environment are not read, because FT_New_Library leaves them out.
 */

#include <stdint.h>
#include <stdlib.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_ADVANCES_H
#include FT_MODULE_H
#include FT_OUTLINE_H
#include FT_SYSTEM_H
#include FT_TRUETYPE_TABLES_H

/* Results; Font.TrueType has the same numbers. */
enum {
  READ = 0,
  NO_FONT = 1,
  NO_OUTLINES = 2,
  NO_CHARACTERS = 3,
  BY_INSTRUCTIONS = 4,
  TOO_LARGE = 5,
  DAMAGED = 6
};

/* Marks in the numbers of the result, each before the points of a part. */
enum { END_OF_GLYPH = 0, MOVE = 1, LINE = 2, CONIC = 3, CUBIC = 4 };

static const size_t most_memory = 256u << 20; /* bytes that FreeType may use at once */
static const size_t most_numbers = 4u << 20;  /* numbers of a result */
static const FT_Pos most_coordinate = 1 << 24;

/* The memory of a library: a header with the size stands before every block. */
typedef union {
  size_t size;
  max_align_t alignment;
} Header;

static void *allocated(FT_Memory memory, long size) {
  size_t *used = memory->user;
  if (size < 0 || (size_t)size > most_memory - *used) return NULL;
  Header *block = malloc(sizeof(Header) + (size_t)size);
  if (block == NULL) return NULL;
  block->size = (size_t)size;
  *used += block->size;
  return block + 1;
}

static void freed(FT_Memory memory, void *pointer) {
  Header *block = (Header *)pointer - 1;
  *(size_t *)memory->user -= block->size;
  free(block);
}

static void *reallocated(FT_Memory memory, long old, long size, void *pointer) {
  size_t *used = memory->user;
  Header *block = (Header *)pointer - 1;
  size_t before = block->size;
  (void)old;
  if (size < 0 || (size_t)size > most_memory - (*used - before)) return NULL;
  block = realloc(block, sizeof(Header) + (size_t)size);
  if (block == NULL) return NULL;
  block->size = (size_t)size;
  *used = *used - before + block->size;
  return block + 1;
}

/* The numbers of the result. After a failure nothing is added. */
typedef struct {
  int32_t *numbers;
  size_t count, room;
  int failure;
} Numbers;

static void add(Numbers *out, FT_Pos number) {
  if (out->failure != READ) return;
  if (number < -most_coordinate || number > most_coordinate) {
    out->failure = DAMAGED;
    return;
  }
  if (out->count == out->room) {
    size_t room = out->room == 0 ? 1024 : 2 * out->room;
    int32_t *larger = room > most_numbers ? NULL : realloc(out->numbers, room * sizeof *larger);
    if (larger == NULL) {
      out->failure = TOO_LARGE;
      return;
    }
    out->numbers = larger;
    out->room = room;
  }
  out->numbers[out->count++] = (int32_t)number;
}

static int add_points(Numbers *out, int mark, int count, const FT_Vector *const *points) {
  add(out, mark);
  for (int i = 0; i < count; i++) {
    add(out, points[i]->x);
    add(out, points[i]->y);
  }
  return out->failure;
}

static int move_to(const FT_Vector *to, void *out) {
  return add_points(out, MOVE, 1, (const FT_Vector *[]){to});
}

static int line_to(const FT_Vector *to, void *out) {
  return add_points(out, LINE, 1, (const FT_Vector *[]){to});
}

static int conic_to(const FT_Vector *control, const FT_Vector *to, void *out) {
  return add_points(out, CONIC, 2, (const FT_Vector *[]){control, to});
}

static int cubic_to(const FT_Vector *first, const FT_Vector *second, const FT_Vector *to,
                    void *out) {
  return add_points(out, CUBIC, 3, (const FT_Vector *[]){first, second, to});
}

static const FT_Int32 unscaled = FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP;

/* Loads a glyph. The result is READ, or TOO_LARGE or DAMAGED. */
static int load(FT_Face face, FT_UInt index) {
  FT_Error error = FT_Load_Glyph(face, index, unscaled);
  if (error == FT_Err_Out_Of_Memory) return TOO_LARGE;
  if (error != 0 || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE) return DAMAGED;
  return READ;
}

/* The height of the capitals: that of the table OS/2 from its version 2 on, or else that of the
 * glyph of H; 0 if the font has neither. */
static FT_Pos capital_height(FT_Face face) {
  TT_OS2 *table = FT_Get_Sfnt_Table(face, FT_SFNT_OS2);
  if (table != NULL && table->version >= 2 && table->version != 0xFFFF && table->sCapHeight > 0)
    return table->sCapHeight;
  FT_UInt index = FT_Get_Char_Index(face, 'H');
  if (index == 0 || load(face, index) != READ || face->glyph->outline.n_points == 0) return 0;
  FT_BBox box;
  FT_Outline_Get_CBox(&face->glyph->outline, &box);
  return box.yMax > 0 ? box.yMax : 0;
}

/* Adds the glyph of a character: its number in the font, its advance, the kerning between it and the
 * character after it, and its outline. The coordinates of the outline are doubled. In this way the
 * points in the middle between two control points, which TrueType leaves out, are whole numbers. A
 * character that the font lacks has only the number 0. */
static void add_glyph(Numbers *out, FT_Face face, uint32_t character, uint32_t next) {
  static const FT_Outline_Funcs calls = {move_to, line_to, conic_to, cubic_to, 1, 0};
  FT_UInt index = FT_Get_Char_Index(face, character);
  FT_Fixed advance;
  FT_Vector kerning = {0, 0};
  add(out, (FT_Pos)index);
  if (index == 0 || out->failure != READ) return;
  out->failure = load(face, index);
  if (out->failure != READ) return;
  if (FT_Get_Advance(face, index, unscaled, &advance) != 0) {
    out->failure = DAMAGED;
    return;
  }
  if (next != 0 && FT_HAS_KERNING(face)) {
    FT_UInt after = FT_Get_Char_Index(face, next);
    if (after != 0 && FT_Get_Kerning(face, index, after, FT_KERNING_UNSCALED, &kerning) != 0)
      kerning.x = 0;
  }
  add(out, advance);
  add(out, kerning.x);
  if (FT_Outline_Decompose(&face->glyph->outline, &calls, out) != 0 && out->failure == READ)
    out->failure = DAMAGED;
  add(out, END_OF_GLYPH);
}

static void read_face(Numbers *out, FT_Face face, const uint32_t *characters, size_t count) {
  if (!FT_IS_SCALABLE(face) || !FT_IS_SFNT(face)) {
    out->failure = NO_OUTLINES;
  } else if (FT_Select_Charmap(face, FT_ENCODING_UNICODE) != 0) {
    out->failure = NO_CHARACTERS;
  } else if (FT_IS_TRICKY(face)) {
    out->failure = BY_INSTRUCTIONS;
  } else {
    add(out, capital_height(face));
    for (size_t i = 0; i < count && out->failure == READ; i++)
      add_glyph(out, face, characters[i], i + 1 < count ? characters[i + 1] : 0);
  }
}

/* Reads the glyphs of a text. The numbers are the height of the capitals, and those of add_glyph for
 * each character. The caller frees them if the result is READ; otherwise there are none. */
int partc_font_text(const unsigned char *font, size_t size, const uint32_t *characters,
                    size_t count, int32_t **numbers, size_t *length) {
  size_t used = 0;
  struct FT_MemoryRec_ memory = {&used, allocated, freed, reallocated};
  Numbers out = {NULL, 0, 0, READ};
  FT_Library library;
  FT_Face face;
  FT_Error error;

  *numbers = NULL;
  *length = 0;
  if (FT_New_Library(&memory, &library) != 0) return TOO_LARGE;
  FT_Add_Default_Modules(library);
  error = FT_New_Memory_Face(library, font, (FT_Long)size, 0, &face);
  if (error == 0) {
    read_face(&out, face, characters, count);
  } else {
    out.failure = error == FT_Err_Out_Of_Memory ? TOO_LARGE : NO_FONT;
  }
  /* The library frees its faces, and all its memory. */
  FT_Done_Library(library);
  if (out.failure != READ) {
    free(out.numbers);
    return out.failure;
  }
  *numbers = out.numbers;
  *length = out.count;
  return READ;
}
