"""Refusals of Typer, click and pydantic in the reader's language."""

import pytest
import typer

from ai4u_edu.cli.main import app
from ai4u_edu.cli.refusals import refusal
from ai4u_edu.locale import PSEUDO, Catalogue, Text, reader

REFUSED = {
    "play --seed x": "escreva um número inteiro",
    "play --seed -1": "escreva um número a partir de 0",
    "play --time-scale 1000": "escreva um número de até 100",
    "play --time-scale x": "escreva um número, com ponto para os decimais",
    "play --on-missing wait": "'wait' não é um de 'hold', 'coast', 'stop'.",
    "play --sed 3": "Não existe a opção --sed",
    "play --zzzz": "Não existe a opção --zzzz",
    "play --seed": "A opção '--seed' precisa de um argumento.",
    "bridge url --realtime=3": "A opção '--realtime' não leva valor.",
    "bridge": "Falta o argumento 'url'.",
    "lessons a b": "Sobraram argumentos inesperados (b)",
    "plya": "Você quis dizer 'play', 'replay'?",
    "zzzz": "Não há comando 'zzzz'.",
    "play maze zoo": "Valor inválido: era esperada uma cena",
}
"""Command lines, and a part of the refusal in Portuguese."""


@pytest.mark.parametrize("words", REFUSED)
def test_a_refusal_is_translated(words: str) -> None:
    with pytest.raises(typer.TyperException) as raised:
        typer.main.get_command(app)(args=words.split(), standalone_mode=False)
    text = refusal(raised.value.format_message(), raised.value.message)
    assert isinstance(text, Text)
    assert text == raised.value.format_message()
    assert REFUSED[words] in Catalogue("pt_BR").translate(text)


def test_a_usage_line_is_translated() -> None:
    with pytest.raises(typer.TyperException) as raised:
        typer.main.get_command(app)(args=["play", "--zzzz"], standalone_mode=False)
    context = raised.value.ctx  # type: ignore[attr-defined]  # a class without a public name
    assert context.get_usage().startswith("Usage: ")
    with reader(PSEUDO):
        assert "Usage" not in context.get_usage()
        assert "[OPTIONS]" not in context.get_usage()
    with reader("pt_BR"):
        assert context.get_usage().endswith("play [OPÇÕES] [scene]")
