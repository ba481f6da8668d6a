"""The frequencies at which a scene is solved."""

import pytest

from scene2hap import Bands, Excitation
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.bands.sampling import AROUND, Sampling


def test_sums_over_a_band_are_exact_for_a_square_of_the_frequency() -> None:
    bands = Bands.third_octaves()
    sampling = Sampling.of(bands, [], 0.02)
    for (low, high), (at, weights) in zip(bands.widths_hz(), sampling.bands, strict=True):
        expected = (high**3 - low**3) / (3 * (high - low))
        assert weights @ sampling.frequencies_hz[at] ** 2 == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("bands", [Bands.third_octaves(), AROUND])
@pytest.mark.parametrize("loss_factor", [0.0, 1e-9])
def test_a_loss_that_no_grid_resolves_is_refused(loss_factor: float, bands: Bands) -> None:
    with pytest.raises(ModelDomainError, match="loss_floor"):
        Sampling.of(bands, [Excitation("phone", 150.0, 150.0)], loss_factor)
