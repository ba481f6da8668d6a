"""The frequencies at which a scene is solved."""

import pytest

from scene2hap import Bands
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.bands.sampling import Sampling


@pytest.mark.parametrize("loss_factor", [0.0, 1e-9])
def test_a_loss_that_no_grid_resolves_is_refused(loss_factor: float) -> None:
    with pytest.raises(ModelDomainError, match="loss_floor"):
        Sampling.of(Bands.third_octaves(), [], loss_factor)
