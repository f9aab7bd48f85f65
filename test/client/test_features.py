"""The features of the language server, driven by a client that checks every message against the protocol."""

import asyncio
import os
import pathlib

import pytest
import pytest_lsp
from lsprotocol import types
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities

PARTC = os.environ.get("PARTC", "partc")
FLANGE = (pathlib.Path(__file__).parents[2] / "examples" / "flange.part").read_text(encoding="utf-8")
URI = "file:///tmp/flange.part"
DOCUMENT = types.TextDocumentIdentifier(uri=URI)


@pytest_lsp.fixture(
    params=["visual-studio-code", "neovim", "emacs"],
    config=ClientServerConfig(server_command=[PARTC, "lsp"]),
)
async def client(request, lsp_client: LanguageClient):
    settled = {}

    @lsp_client.feature("partc/settled")
    def _(params):
        settled[params.uri] = params.version

    @lsp_client.feature("partc/proof")
    def _(_):
        pass

    for method in ("client/registerCapability", "workspace/codeLens/refresh"):

        @lsp_client.feature(method)
        def _(_):
            return None

    lsp_client.settled_versions = settled
    await lsp_client.initialize_session(
        types.InitializeParams(capabilities=client_capabilities(request.param), process_id=os.getpid())
    )
    yield
    await lsp_client.shutdown_session()


async def open_text(client, text, uri=URI, version=1):
    client.text_document_did_open(
        types.DidOpenTextDocumentParams(
            text_document=types.TextDocumentItem(uri=uri, language_id="part", version=version, text=text)
        )
    )
    await settle(client, version, uri)


async def change(client, version, edits, uri=URI):
    client.text_document_did_change(
        types.DidChangeTextDocumentParams(
            text_document=types.VersionedTextDocumentIdentifier(uri=uri, version=version), content_changes=edits
        )
    )
    await settle(client, version, uri)


async def settle(client, version, uri=URI):
    for _ in range(6000):
        if client.settled_versions.get(uri) == version:
            return
        await asyncio.sleep(0.01)
    raise AssertionError("the diagnostics did not settle")


def place(text, words, offset=0):
    """The position of the first occurrence of some words."""
    before = text[: text.index(words) + offset]
    return types.Position(line=before.count("\n"), character=len(before.rsplit("\n", 1)[-1].encode("utf-16-le")) // 2)


def whole(text):
    return types.TextDocumentContentChangeWholeDocument(text=text)


def applied(text, edits):
    """The text after edits, which do not overlap."""
    lines = text.splitlines(keepends=True) + [""]

    def offset(position):
        line = lines[position.line]
        units = line.encode("utf-16-le")[: 2 * position.character].decode("utf-16-le")
        return sum(map(len, lines[: position.line])) + len(units)

    for edit in sorted(edits, key=lambda e: offset(e.range.start), reverse=True):
        text = text[: offset(edit.range.start)] + edit.new_text + text[offset(edit.range.end) :]
    return text


@pytest.mark.asyncio
async def test_diagnostics_come_and_go(client):
    wrong = FLANGE.replace("outline outside", "outlime outside")
    await open_text(client, wrong)
    assert [d.code for d in client.diagnostics[URI]] == ["E0201"]
    await change(client, 2, [whole(FLANGE)])
    assert len(client.diagnostics[URI]) == 0


@pytest.mark.asyncio
async def test_hover_and_definition(client):
    await open_text(client, FLANGE)
    at = place(FLANGE, "mill outline", 6)
    hover = await client.text_document_hover_async(types.HoverParams(text_document=DOCUMENT, position=at))
    assert "outline" in str(hover.contents)
    definition = await client.text_document_definition_async(
        types.DefinitionParams(text_document=DOCUMENT, position=at)
    )
    assert definition.range.start == place(FLANGE, "contour outline", 8)


@pytest.mark.asyncio
async def test_symbols(client):
    await open_text(client, FLANGE)
    symbols = await client.text_document_document_symbol_async(types.DocumentSymbolParams(text_document=DOCUMENT))
    assert [s.name for s in symbols][:5] == ["flange", "c", "lug", "boss", "outline"]


@pytest.mark.asyncio
async def test_completion_of_a_contour_after_mill(client):
    text = FLANGE.replace("mill outline outside", "mill out")
    await open_text(client, FLANGE)
    await change(client, 2, [whole(text)])
    found = await client.text_document_completion_async(
        types.CompletionParams(text_document=DOCUMENT, position=place(text, "mill out", 8))
    )
    items = found.items if hasattr(found, "items") else found
    assert "outline" in [i.label for i in items]


@pytest.mark.asyncio
async def test_signature_of_a_call(client):
    await open_text(client, FLANGE)
    signatures = await client.text_document_signature_help_async(
        types.SignatureHelpParams(text_document=DOCUMENT, position=place(FLANGE, "polar(41,", 9))
    )
    assert "polar" in signatures.signatures[0].label
    assert signatures.active_parameter == 1 or signatures.signatures[0].active_parameter == 1


@pytest.mark.asyncio
async def test_references_and_rename(client):
    await open_text(client, FLANGE)
    at = place(FLANGE, "contour outline", 8)
    references = await client.text_document_references_async(
        types.ReferenceParams(
            text_document=DOCUMENT, position=at, context=types.ReferenceContext(include_declaration=True)
        )
    )
    assert len(references) == 2
    highlights = await client.text_document_document_highlight_async(
        types.DocumentHighlightParams(text_document=DOCUMENT, position=at)
    )
    assert len(highlights) == 2
    renamed = await client.text_document_rename_async(
        types.RenameParams(text_document=DOCUMENT, position=at, new_name="profile")
    )
    edits = renamed.changes[URI] if renamed.changes else [e for d in renamed.document_changes for e in d.edits]
    assert applied(FLANGE, edits) == FLANGE.replace("contour outline", "contour profile").replace(
        "mill outline", "mill profile"
    )


@pytest.mark.asyncio
async def test_references_and_rename_in_several_programs(client, tmp_path):
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real")
    texts = {
        (tmp_path / "real" / "pins.part").as_uri(): "part pins\nlet pin = 3 mm\n",
        (tmp_path / "link" / "plate.part").as_uri(): 'part plate\nimport "pins.part"\nlet a = pin\nlet b = pin\n',
        (tmp_path / "real" / "cover.part").as_uri(): 'part cover\nimport "plate.part"\nlet c = pin\n',
    }
    for uri, text in texts.items():
        (tmp_path / "real" / uri.rsplit("/", 1)[-1]).write_text(text, encoding="utf-8")
        await open_text(client, text, uri=uri)
    library, plate, cover = texts
    for uri, words, offset in ((library, "let pin", 4), (plate, "= pin", 2), (cover, "= pin", 2)):
        at = place(texts[uri], words, offset)
        document = types.TextDocumentIdentifier(uri=uri)
        references = await client.text_document_references_async(
            types.ReferenceParams(
                text_document=document, position=at, context=types.ReferenceContext(include_declaration=True)
            )
        )
        assert sorted(r.uri for r in references) == sorted([library, plate, plate, cover])
        renamed = await client.text_document_rename_async(
            types.RenameParams(text_document=document, position=at, new_name="bolt")
        )
        assert {u: applied(texts[u], edits) for u, edits in renamed.changes.items()} == {
            u: text.replace("let pin", "let bolt").replace("= pin", "= bolt") for u, text in texts.items()
        }
        with pytest.raises(Exception, match="is taken"):
            await client.text_document_rename_async(
                types.RenameParams(text_document=document, position=at, new_name="c")
            )


@pytest.mark.asyncio
async def test_a_fix_mends_its_mistake(client):
    wrong = FLANGE.replace("mill outline", "mill outlien")
    await open_text(client, wrong)
    diagnostics = client.diagnostics[URI]
    actions = await client.text_document_code_action_async(
        types.CodeActionParams(
            text_document=DOCUMENT,
            range=diagnostics[0].range,
            context=types.CodeActionContext(diagnostics=diagnostics),
        )
    )
    assert applied(wrong, actions[0].edit.changes[URI]) == FLANGE


@pytest.mark.asyncio
async def test_formatting_restores_the_layout(client):
    untidy = FLANGE.replace("feed      60", "feed 60").replace("  approach", "      approach")
    await open_text(client, untidy)
    edits = await client.text_document_formatting_async(
        types.DocumentFormattingParams(
            text_document=DOCUMENT, options=types.FormattingOptions(tab_size=2, insert_spaces=True)
        )
    )
    assert applied(untidy, edits) == FLANGE


@pytest.mark.asyncio
async def test_the_structure_of_the_text(client):
    await open_text(client, FLANGE)
    folds = await client.text_document_folding_range_async(types.FoldingRangeParams(text_document=DOCUMENT))
    contour = place(FLANGE, "contour outline").line
    assert contour in [f.start_line for f in folds]
    at = place(FLANGE, "fillet -36", 8)
    (selection,) = await client.text_document_selection_range_async(
        types.SelectionRangeParams(text_document=DOCUMENT, positions=[at])
    )
    sizes = []
    while selection:
        sizes.append((selection.range.end.line - selection.range.start.line))
        selection = selection.parent
    assert len(sizes) >= 3 and sizes == sorted(sizes)
    tokens = await client.text_document_semantic_tokens_full_async(
        types.SemanticTokensParams(text_document=DOCUMENT)
    )
    assert len(tokens.data) > 0 and len(tokens.data) % 5 == 0


@pytest.mark.asyncio
async def test_lenses_hints_and_links(client):
    await open_text(client, FLANGE)
    lenses = await client.text_document_code_lens_async(types.CodeLensParams(text_document=DOCUMENT))
    assert any("lkp-01f" in lens.command.title for lens in lenses)
    await client.text_document_inlay_hint_async(
        types.InlayHintParams(
            text_document=DOCUMENT,
            range=types.Range(start=types.Position(line=0, character=0), end=types.Position(line=20, character=0)),
        )
    )
    importing = 'part p\nimport "pins.part"\n'
    await change(client, 2, [whole(importing)])
    links = await client.text_document_document_link_async(types.DocumentLinkParams(text_document=DOCUMENT))
    assert [link.range.start.line for link in links] == [1]


@pytest.mark.asyncio
async def test_a_new_line_closes_a_block(client):
    text = FLANGE + "\ncontour more closed {\n"
    await open_text(client, text)
    edits = await client.text_document_on_type_formatting_async(
        types.DocumentOnTypeFormattingParams(
            text_document=DOCUMENT,
            position=types.Position(line=text.count("\n"), character=0),
            ch="\n",
            options=types.FormattingOptions(tab_size=2, insert_spaces=True),
        )
    )
    assert "}" in "".join(e.new_text for e in edits or [])


@pytest.mark.asyncio
async def test_symbols_of_all_documents(client):
    await open_text(client, FLANGE)
    found = await client.workspace_symbol_async(types.WorkspaceSymbolParams(query="outl"))
    assert "outline" in [s.name for s in found]


@pytest.mark.asyncio
async def test_what_is_at_a_position(client):
    await open_text(client, FLANGE)
    at = place(FLANGE, "contour outline", 9)
    found = await client.protocol.send_request_async(
        "partc/at", {"textDocument": {"uri": URI}, "position": {"line": at.line, "character": at.character}}
    )
    assert found.title == "outline" and "<svg" in found.svg


@pytest.mark.asyncio
async def test_a_machine_description_has_diagnostics_and_completion(client):
    uri = "file:///tmp/mine.machine"
    text = 'machine mine "a mill" reconstructed "none"\naxis x {\n  puls 0.01 mm\n}\n'
    await open_text(client, text, uri)
    assert len(client.diagnostics[uri]) > 0
    found = await client.text_document_completion_async(
        types.CompletionParams(
            text_document=types.TextDocumentIdentifier(uri=uri), position=types.Position(line=2, character=6)
        )
    )
    assert "pulse" in [i.label for i in (found.items if hasattr(found, "items") else found)]
