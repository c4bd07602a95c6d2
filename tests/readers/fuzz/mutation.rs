//! Seeded changes of real inputs that keep most of their structure.

/// A small generator of random numbers: xorshift64*, whose every seed but zero is good.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        // Neighbouring seeds must not give neighbouring streams.
        let mixed = seed.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        Self(mixed | 1)
    }

    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    /// A number below `count`, 0 for none.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    pub fn pick<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[self.below(items.len())]
    }
}

/// Values that break what was not thought of.
const NUMBERS: &str = "0 ; -1 ; 1 ; 2 ; 0.5 ; -0.0 ; 1e308 ; -1e308 ; 1e-320 ; nan ; inf ; -inf ; true ; \"\" ; [] ; {} ; \
     [1, 2] ; 99999999999 ; 9223372036854775807 ; 1e9 ; 1e-9 ; 0x10";

/// Pieces of grammar of the texts that the program reads.
const PIECES: [&str; 17] = [
    "\n", "\r\n", ",", ";", "\t", "=", "[", "]", "\"", "#", ".", "e", "-", "i", " ", "\u{feff}",
    "\0",
];
const RANGE: &str = "{ from = 0, to = 1, count = 3 }";

/// A text with one to four changes: numbers and words exchanged, lines deleted, doubled, moved or taken from another text,
/// pieces of grammar put in, bytes changed.
pub fn text(random: &mut Random, corpus: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = random.pick(corpus).clone();
    for _ in 0..=random.below(4) {
        match random.below(8) {
            0..=2 => replace_token(random, &mut bytes),
            3 => {
                let mut own = lines(&bytes);
                let [at, change, other] =
                    [own.len(), 3, own.len()].map(|count| random.below(count));
                match change {
                    0 => drop(own.remove(at)),
                    1 => own.insert(at, own[at]),
                    _ => own.swap(at, other),
                }
                bytes = own.join(&b'\n');
            }
            4 => {
                let other = lines(random.pick::<Vec<u8>>(corpus));
                let mut own = lines(&bytes);
                own.insert(random.below(own.len()), other[random.below(other.len())]);
                bytes = own.join(&b'\n');
            }
            5 => {
                let at = random.below(bytes.len() + 1);
                let piece = PIECES.get(random.below(18)).unwrap_or(&RANGE).as_bytes();
                bytes.splice(at..at, piece.iter().copied());
            }
            6 => binary_change(random, &mut bytes),
            _ => bytes.truncate(random.below(bytes.len() + 1)),
        }
    }
    bytes
}

fn lines(bytes: &[u8]) -> Vec<&[u8]> {
    bytes.split(|&byte| byte == b'\n').collect()
}

fn replace_token(random: &mut Random, bytes: &mut Vec<u8>) {
    let is_part = |byte: u8| byte.is_ascii_alphanumeric() || b"+-._".contains(&byte);
    let is_start = |i: &usize| is_part(bytes[*i]) && (*i == 0 || !is_part(bytes[i - 1]));
    let starts: Vec<usize> = (0..bytes.len()).filter(is_start).collect();
    if starts.is_empty() {
        return;
    }
    let length = |start: usize| bytes[start..].iter().take_while(|&&b| is_part(b)).count();
    let [start, other] = [0, 1].map(|_| *random.pick(&starts));
    let place = start..start + length(start);
    let new: Vec<u8> = match random.below(4) {
        0 => bytes[other..other + length(other)].to_vec(),
        1 => format!("{:e}", f64::from_bits(random.next())).into_bytes(),
        _ => random.pick(&NUMBERS.split(" ; ").collect::<Vec<&str>>()).as_bytes().to_vec(),
    };
    bytes.splice(place, new);
}

/// A changed text or a changed file of bytes.
pub fn either(random: &mut Random, texts: &[Vec<u8>], binaries: &[Vec<u8>]) -> Vec<u8> {
    if random.below(2) == 0 {
        return text(random, texts);
    }
    let file = random.below(binaries.len());
    binary(random, &binaries[file])
}

/// Bytes with one to six changes: set, flipped, put in, taken out, ranges copied.
pub fn binary(random: &mut Random, original: &[u8]) -> Vec<u8> {
    let mut bytes = original.to_vec();
    for _ in 0..=random.below(6) {
        binary_change(random, &mut bytes);
    }
    bytes
}

fn binary_change(random: &mut Random, bytes: &mut Vec<u8>) {
    if bytes.is_empty() {
        bytes.push(random.next() as u8);
        return;
    }
    // Lengths and counts stand near the beginning: half of the changes go there.
    let reach = if random.below(2) == 0 { bytes.len().min(64) } else { bytes.len() };
    let at = random.below(reach);
    match random.below(6) {
        0 => bytes[at] = random.next() as u8,
        1 => bytes[at] ^= 1 << random.below(8),
        2 => bytes[at] = *random.pick(&[0, 1, 2, 0x7f, 0x80, 0xff]),
        3 => bytes.insert(at, random.next() as u8),
        4 => drop(bytes.remove(at)),
        _ => {
            let length = random.below(16).min(bytes.len() - at);
            let piece = bytes[at..at + length].to_vec();
            let to = random.below(bytes.len());
            bytes.splice(to..to, piece);
        }
    }
}
