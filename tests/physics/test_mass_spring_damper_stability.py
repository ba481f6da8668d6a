"""A short form of the campaign `stress/propagation.py`: extreme plates, scenes and steps cause no fault."""

import signal
from types import ModuleType

import pytest

from scene2hap import Material, Plate
from scene2hap.errors import ModelDomainError
from scripts import script


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    if not hasattr(signal, "SIGPROF"):
        pytest.skip("the campaign limits processor time by SIGPROF, which this system lacks")
    return script("stress/propagation.py")


def test_every_model_answers_or_refuses(campaign: ModuleType) -> None:
    tallies = campaign.run(2, 2, 30.0)
    assert {name: tally.bad for name, tally in tallies.items() if tally.bad} == {}
    assert len(tallies) == 2 * len(campaign.MODELS)
    assert all(tally.answered for tally in tallies.values())


def test_no_stepper_gains_energy(campaign: ModuleType) -> None:
    for name, dt, gain, drift in [*campaign.steppers(300), *campaign.lattice_steppers(100)]:
        assert gain <= 1e-12, (name, dt)
        assert drift <= 1e-12, (name, dt)


def test_campaign_detects_each_kind_of_fault(campaign: ModuleType) -> None:
    def spin() -> object:
        while True:
            pass

    def refuse() -> object:
        raise ModelDomainError("no")

    tally = campaign.Tally()
    tally.run("infinite", 5.0, lambda: campaign.np.array([float("inf")]))
    tally.run("foreign", 5.0, lambda: 1 / 0)
    tally.run("unclear", 5.0, refuse)
    tally.run("endless", 0.05, spin)
    tally.run("clear", 5.0, lambda: Plate(1.0, -1.0, 0.1, Material("m", 1.0, 1.0, 0.0)))
    tally.run("fine", 5.0, lambda: campaign.np.zeros(3))
    kinds = [line.split(":")[0] for line in tally.bad]
    assert kinds == ["infinite", "foreign", "unclear", "endless"]
    assert (tally.answered, tally.refused.total()) == (1, 1)
