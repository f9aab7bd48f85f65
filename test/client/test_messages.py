"""Messages that no good client sends: each request whose identifier can be read gets one answer."""

import json
import os
import subprocess

import pytest

PARTC = os.environ.get("PARTC", "partc")


def framed(body: bytes) -> bytes:
    return b"Content-Length: %d\r\n\r\n" % len(body) + body


def message(**fields) -> bytes:
    return framed(json.dumps({"jsonrpc": "2.0", **fields}).encode())


def talk(*messages: bytes):
    """All messages of the server, and its exit status, after the client has sent these messages and closed the
    stream."""
    process = subprocess.run([PARTC, "lsp"], input=b"".join(messages), capture_output=True, timeout=60)
    assert process.stderr == b""
    rest, received = process.stdout, []
    while rest:
        head, _, rest = rest.partition(b"\r\n\r\n")
        size = int(head.split(b":")[1])
        received.append(json.loads(rest[:size]))
        rest = rest[size:]
    return received, process.returncode


def answers(received):
    return [(m["id"], m["error"]["code"] if "error" in m else None) for m in received if "id" in m and "method" not in m]


INITIALIZE = message(id=0, method="initialize", params={"capabilities": {}})
SHUTDOWN = message(id=99, method="shutdown")
EXIT = message(method="exit")


def test_malformed_messages_are_refused_and_the_server_lives_on():
    received, status = talk(
        INITIALIZE,
        framed(b"{"),
        framed(b"[]"),
        framed(b"17"),
        framed(b'{"id":3}'),
        framed(b'{"id":"x","method":5}'),
        framed(b'{"id":[1],"method":"shutdown"}'),
        framed(b"\xff\xfe"),
        b"Content-Length: many\r\n\r\n",
        SHUTDOWN,
        EXIT,
    )
    assert answers(received) == [
        (0, None),
        (None, -32700),
        (None, -32600),
        (None, -32600),
        (3, -32600),
        ("x", -32600),
        (None, -32600),
        (None, -32700),
        (99, None),
    ]
    assert status == 0


def test_requests_in_the_wrong_order_are_refused():
    received, status = talk(
        message(id=1, method="textDocument/hover", params={}),
        INITIALIZE,
        message(id=2, method="initialize", params={}),
        SHUTDOWN,
        message(id=3, method="textDocument/hover", params={}),
        message(id=4, method="shutdown"),
        EXIT,
    )
    assert answers(received) == [(1, -32002), (0, None), (2, -32600), (99, None), (3, -32600), (4, -32600)]
    assert status == 0


def test_duplicated_and_unknown_requests_are_answered():
    place = {"textDocument": {"uri": "file:///nowhere.part"}, "position": {"line": 0, "character": 0}}
    received, _ = talk(
        INITIALIZE,
        message(id=1, method="textDocument/hover", params=place),
        message(id=1, method="textDocument/hover", params=place),
        message(id=2, method="partc/unknown"),
        message(id=3, method="textDocument/hover", params=[]),
        message(id=4, method="textDocument/hover"),
        message(method="partc/unknown"),
        message(method="$/cancelRequest", params={"id": 77}),
        SHUTDOWN,
        EXIT,
    )
    assert answers(received) == [(0, None), (1, None), (1, None), (2, -32601), (3, -32602), (4, -32602), (99, None)]


def test_a_request_that_waits_is_answered_once_when_it_is_cancelled():
    document = {"uri": "file:///tmp/a.part", "languageId": "part", "version": 1, "text": "part a\n" * 20000}
    received, _ = talk(
        INITIALIZE,
        message(method="textDocument/didOpen", params={"textDocument": document}),
        message(id=1, method="textDocument/formatting", params={"textDocument": document, "options": {}}),
        message(method="$/cancelRequest", params={"id": 1}),
        message(id=2, method="textDocument/formatting", params={"textDocument": document, "options": {}}),
        SHUTDOWN,
        EXIT,
    )
    assert sorted(ident for ident, _ in answers(received)) == [0, 1, 2, 99]


def test_a_message_that_is_too_long_does_not_stop_the_server():
    received, status = talk(INITIALIZE, b"Content-Length: 999999999999\r\n\r\n", SHUTDOWN, EXIT)
    assert answers(received) == [(0, None), (99, None)]
    assert status == 0


@pytest.mark.parametrize("half", ["\\ud83d", "\\ude42"])
def test_half_of_a_surrogate_pair_is_replaced(half):
    body = (
        '{"jsonrpc":"2.0","method":"textDocument/didOpen","params":{"textDocument":{"uri":"file:///tmp/a.part",'
        '"languageId":"part","version":1,"text":"part a -- ' + half + '\\nlet a = b\\n"}}}'
    )
    received, _ = talk(INITIALIZE, framed(body.encode()), message(id=1, method="textDocument/formatting", params={
        "textDocument": {"uri": "file:///tmp/a.part"}, "options": {}}), SHUTDOWN, EXIT)
    assert answers(received)[0] == (0, None)
    assert {ident for ident, _ in answers(received)} == {0, 1, 99}


def test_the_exit_status_says_whether_the_end_was_orderly():
    assert [talk(INITIALIZE)[1], talk(INITIALIZE, EXIT)[1], talk(INITIALIZE, SHUTDOWN, EXIT)[1], talk()[1]] == [1, 1, 0, 1]
