from .rank_tests import RankTest as RankTest
from .rank_tests import kruskal_wallis as kruskal_wallis
from .rank_tests import meyer_bahlburg as meyer_bahlburg
from .rank_tests import siegel_tukey_ranks as siegel_tukey_ranks
from .spectra import SpectralDifference as SpectralDifference
from .spectra import spectral_difference as spectral_difference
