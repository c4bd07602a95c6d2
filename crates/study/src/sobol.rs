//! Points that fill a cube evenly: Sobol's sequence, scrambled.

/// Degree, polynomial and initial direction numbers of dimensions 2 to 32.
///
/// S. Joe, F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30
/// (2008) 2635, their table new-joe-kuo-6.21201.
const DIRECTIONS: [(u32, u32, &[u32]); 31] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
    (6, 19, &[1, 1, 1, 15, 7, 5]),
    (6, 22, &[1, 3, 1, 15, 13, 25]),
    (6, 25, &[1, 1, 5, 5, 19, 61]),
    (7, 1, &[1, 3, 7, 11, 23, 15, 103]),
    (7, 4, &[1, 3, 7, 13, 13, 15, 69]),
    (7, 7, &[1, 1, 3, 13, 7, 35, 63]),
    (7, 8, &[1, 3, 5, 9, 1, 25, 53]),
    (7, 14, &[1, 3, 1, 13, 9, 35, 107]),
    (7, 19, &[1, 3, 1, 5, 27, 61, 31]),
    (7, 21, &[1, 1, 5, 11, 19, 41, 61]),
    (7, 28, &[1, 3, 5, 3, 3, 13, 69]),
    (7, 31, &[1, 1, 7, 13, 1, 19, 1]),
    (7, 32, &[1, 3, 7, 5, 13, 19, 59]),
    (7, 37, &[1, 1, 3, 9, 25, 29, 41]),
    (7, 41, &[1, 3, 5, 13, 23, 1, 55]),
    (7, 42, &[1, 3, 7, 3, 13, 59, 17]),
];

/// Sobol's sequence under Owen's nested uniform scrambling: it stays even, and every point is uniformly distributed.
///
/// Each coordinate is scrambled by a hash of its leading digits: A. B. Owen, "Scrambling Sobol and Niederreiter-Xing
/// points", J. Complexity 14 (1998) 466; B. Burley, "Practical hash-based Owen scrambling", JCGT 9 (2020) 4.
#[derive(Clone, Debug)]
pub struct ScrambledSobol {
    /// Direction numbers and scrambling seed of each dimension.
    dimensions: Vec<([u32; 32], u32)>,
}

impl ScrambledSobol {
    /// Dimensions that there are direction numbers for.
    pub const LARGEST_DIMENSION: usize = DIRECTIONS.len() + 1;

    /// The sequence in so many dimensions, at most [`Self::LARGEST_DIMENSION`].
    pub fn new(dimensions: usize, seed: u64) -> Self {
        let of = |dimension: usize| (directions(dimension), mixed(seed, dimension as u64));
        Self { dimensions: (0..dimensions.min(Self::LARGEST_DIMENSION)).map(of).collect() }
    }

    /// Point `index`, each coordinate between 0 and 1, ends excluded.
    pub fn point(&self, index: u32) -> Vec<f64> {
        let coordinate = |(directions, seed): &([u32; 32], u32)| {
            let set = (0..32).filter(|bit| index >> bit & 1 == 1);
            let plain = set.fold(0, |x, bit| x ^ directions[bit]);
            (f64::from(scrambled(plain, *seed)) + 0.5) / (1u64 << 32) as f64
        };
        self.dimensions.iter().map(coordinate).collect()
    }
}

fn directions(dimension: usize) -> [u32; 32] {
    let Some((degree, polynomial, initial)) = dimension.checked_sub(1).map(|d| DIRECTIONS[d])
    else {
        return std::array::from_fn(|bit| 1 << (31 - bit));
    };
    let s = degree as usize;
    let mut v = [0u32; 32];
    for bit in 0..32 {
        v[bit] = if bit < s {
            initial[bit] << (31 - bit)
        } else {
            let set = (1..s).filter(|k| polynomial >> (s - 1 - k) & 1 == 1);
            set.fold(v[bit - s] ^ (v[bit - s] >> s), |x, k| x ^ v[bit - k])
        };
    }
    v
}

/// Flips each binary digit by a hash of those before it.
fn scrambled(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// A seed for each dimension (splitmix64).
fn mixed(seed: u64, dimension: u64) -> u32 {
    let mut z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for word in [dimension, 0x2545_f491] {
        z = z.wrapping_add(word).wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
    }
    (z >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_dimension_has_one_point_in_each_of_equal_intervals() {
        for seed in [1, 2] {
            let sequence = ScrambledSobol::new(ScrambledSobol::LARGEST_DIMENSION, seed);
            let points: Vec<Vec<f64>> = (0..1024).map(|i| sequence.point(i)).collect();
            for dimension in 0..ScrambledSobol::LARGEST_DIMENSION {
                let cell = |p: &Vec<f64>| (1024.0 * p[dimension]) as usize;
                let mut cells: Vec<usize> = points.iter().map(cell).collect();
                cells.sort_unstable();
                assert_eq!(cells, (0..1024).collect::<Vec<_>>(), "{dimension}");
            }
        }
    }

    #[test]
    fn the_first_two_dimensions_have_one_point_in_each_elementary_box() {
        let sequence = ScrambledSobol::new(2, 5);
        for bits in 0..=8 {
            let cell = |i: u32| {
                let p = sequence.point(i);
                let (wide, high) = (f64::from(1u32 << bits), f64::from(1u32 << (8 - bits)));
                ((wide * p[0]) as usize, (high * p[1]) as usize)
            };
            let mut cells: Vec<_> = (0..256).map(cell).collect();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells.len(), 256);
        }
    }

    #[test]
    fn the_error_of_a_smooth_mean_falls_far_faster_than_that_of_random_points() {
        let error = |count: u32| {
            let runs = (0..16u64).map(|seed| {
                let sequence = ScrambledSobol::new(6, seed);
                let values = (0..count).map(|i| {
                    let x = sequence.point(i);
                    x.iter().map(|x| 1.0 + (x - 0.5)).product::<f64>()
                });
                (values.sum::<f64>() / f64::from(count) - 1.0).powi(2)
            });
            (runs.sum::<f64>() / 16.0).sqrt()
        };
        // Root mean square errors: random points would have 0.85 / sqrt(n), 1.3e-2 at 4096.
        assert!(error(4096) < 2e-4, "{}", error(4096));
        assert!(error(256) / error(4096) > 8.0);
    }
}
