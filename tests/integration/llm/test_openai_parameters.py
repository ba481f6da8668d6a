"""Parameters that newer OpenAI models refuse are dropped or renamed once, with a warning, and remembered."""

import asyncio
import warnings

import pytest

from llm_asking import ask, openai
from llm_server import Asked, Scripted, refused, request, said
from openai_schema import assert_openai_takes, openai_serving
from scene2hap import (
    BackendWarning,
)
from scene2hap.errors import BackendUnavailable


def no_parameter(name: str, code: str | None = "unsupported_value") -> Scripted:
    error = {"message": f"Unsupported value: '{name}'", "type": "invalid_request_error", "param": name, "code": code}
    return refused(400, error)


@pytest.mark.parametrize("code", ["unsupported_value", None])
def test_reasoning_models_reject_temperature(code: str | None) -> None:
    with openai_serving(no_parameter("temperature", code), said(), said()) as server:
        backend = openai(server, model="o3")
        with pytest.warns(BackendWarning, match="o3 does not take 'temperature'; it is no longer sent"):
            ask(backend)
        ask(backend)
    assert ["temperature" in body for body in server.bodies] == [True, False, False]


@pytest.mark.parametrize("quote", ["'", '"', "`"])
def test_a_gateway_names_the_parameter_in_its_message_alone(quote: str) -> None:
    names = [f"{quote}{name}{quote}" for name in ("max_tokens", "max_completion_tokens")]
    error = {"message": f"Unsupported parameter: {names[0]}. Use {names[1]} instead.", "param": None, "code": None}
    with openai_serving(refused(400, error), said()) as server, pytest.warns(BackendWarning, match="'max_tokens'"):
        ask(openai(server, max_tokens=300))
    assert server.bodies[1]["max_completion_tokens"] == 300


@pytest.mark.parametrize("named", [{"param": "max_tokens", "code": "invalid_value"}, {"param": None, "code": None}])
def test_too_large_a_value_is_an_error_and_no_rejected_parameter(named: dict[str, object]) -> None:
    """With words of vLLM, which OpenAI's resemble. Sent by its other name, the value would be too large again."""
    message = "'max_tokens' or 'max_completion_tokens' is too large: 200000. The maximum context length is 2048 tokens."
    error = {"message": message, "type": "BadRequestError", **named}
    with openai_serving(refused(400, error)) as server, pytest.raises(BackendUnavailable, match="too large: 200000"):
        ask(openai(server, max_tokens=200_000))
    assert len(server.bodies) == 1


def test_a_service_without_strict_output_is_sent_to_the_kind_that_needs_none() -> None:
    error = {"message": "This response_format type is unavailable now", "type": "invalid_request_error"}
    with openai_serving(refused(400, error)) as server, pytest.raises(BackendUnavailable, match="use kind 'local'"):
        ask(openai(server))


def test_max_tokens_is_renamed_and_seed_dropped() -> None:
    script = (no_parameter("max_tokens", "unsupported_parameter"), no_parameter("seed"), said())
    with openai_serving(*script) as server:
        backend = openai(server, max_tokens=300, seed=1)
        with pytest.warns(BackendWarning) as caught:
            ask(backend)
    assert len(caught) == 2
    assert server.bodies[0]["max_tokens"] == 300
    assert server.bodies[2]["max_completion_tokens"] == 300
    assert not {"max_tokens", "seed"} & set(server.bodies[2])
    assert_openai_takes(server.bodies[2])


def test_top_p_is_sent_on_request_and_dropped_when_refused() -> None:
    with (
        openai_serving(no_parameter("top_p"), said()) as server,
        pytest.warns(BackendWarning, match="'top_p'; it is no longer sent"),
    ):
        ask(openai(server, top_p=0.9))
    assert [body.get("top_p") for body in server.bodies] == [0.9, None]


def test_reasoning_effort_is_sent_and_never_dropped() -> None:
    """With "none", gpt-5.1 to 5.6 accept a temperature. A model without reasoning effort raises an error."""
    with openai_serving(said(), no_parameter("reasoning_effort")) as server:
        backend = openai(server, model="gpt-5.4", reasoning_effort="none")
        ask(backend)
        with pytest.raises(BackendUnavailable, match="'reasoning_effort'"):
            ask(backend)
    assert [(body["reasoning_effort"], body["temperature"]) for body in server.bodies] == [("none", 0.2)] * 2


def test_refused_parameters_are_remembered_per_model() -> None:
    with openai_serving(no_parameter("temperature"), said(), said()) as server:
        with pytest.warns(BackendWarning):
            ask(openai(server, model="o3"))
        ask(openai(server, model="gpt-4o"))
    assert "temperature" in server.bodies[2]


def test_concurrent_calls_learn_and_warn_once() -> None:
    def strict(asked: Asked) -> Scripted:
        return no_parameter("temperature") if "temperature" in asked.body else said()

    with openai_serving(by=strict) as server:
        backend = openai(server)

        async def all_at_once() -> None:
            await asyncio.gather(*(backend.complete(request()) for _ in range(6)))

        with pytest.warns(BackendWarning) as caught:
            asyncio.run(all_at_once())
    assert len(caught) == 1


@pytest.mark.parametrize("param", ["temperature", "response_format", "messages", ""])
def test_optional_parameter_is_dropped_once_and_required_ones_never(param: str) -> None:
    warnings.simplefilter("ignore", BackendWarning)
    with (
        openai_serving(no_parameter(param)) as server,
        pytest.raises(BackendUnavailable, match="answered 400") as caught,
    ):
        ask(openai(server))
    assert not caught.value.retryable
    assert len(server.asked) == (2 if param == "temperature" else 1)
