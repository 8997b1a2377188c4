use super::*;
use kontur_kit::Random;

/// Formatted alone, and as a number of a table.
fn fixed(value: f64, decimals: u8) -> String {
    let (mut out, mut row) = (Cells::default(), Cells::default());
    out.push_fixed(value, decimals);
    let mut numbers = NumberTable::new(&[2, decimals]);
    numbers.take(&[vec![0.5, 0.7], vec![0.5, value]], 0..2);
    numbers.push(&mut row, 1, 1..2);
    let text = String::from_utf8(out.as_bytes().to_vec()).unwrap();
    assert_eq!(row.as_bytes(), format!("{text},").as_bytes());
    text
}

/// Schoolbook: the exact decimal expansion of the f64 (never more than 1074 digits), rounded half away by hand.
fn reference(value: f64, decimals: usize) -> String {
    let exact = format!("{:.1100}", value.abs());
    let (whole, part) = exact.split_once('.').unwrap();
    let mut digits: Vec<u8> = format!("{whole}{}", &part[..decimals]).into_bytes();
    if part.as_bytes()[decimals] >= b'5' {
        let mut i = digits.len();
        loop {
            if i == 0 {
                digits.insert(0, b'1');
                break;
            }
            i -= 1;
            if digits[i] < b'9' {
                digits[i] += 1;
                break;
            }
            digits[i] = b'0';
        }
    }
    let zero = digits.iter().all(|&d| d == b'0');
    let mut text = String::from_utf8(digits).unwrap();
    if decimals > 0 {
        text.insert(text.len() - decimals, '.');
    }
    if value < 0.0 && !zero { format!("-{text}") } else { text }
}

#[test]
fn equals_the_exact_expansion() {
    let mut random = Random::new(1);
    for i in 0..4000 {
        let bits = random.bits();
        // plain mantissas, halves of the last digit and their neighbours, and fractions that tie exactly
        let unit = (bits >> 11) as f64 / (1u64 << 53) as f64;
        let tie = ((bits >> 40) as f64 + 0.5) / 1e7;
        let value = match i % 6 {
            0 => unit * 1000.0,
            1 => unit * 1e-6,
            2 => tie,
            3 => tie.next_up(),
            4 => tie.next_down(),
            _ => (bits >> 44) as f64 / 256.0,
        };
        for decimals in [0, 2, 4, 6, 7] {
            for v in [value, -value] {
                assert_eq!(
                    fixed(v, decimals),
                    reference(v, usize::from(decimals)),
                    "{v:e} {decimals}"
                );
            }
        }
    }
}

/// Columns of which most rows repeat the digits before the point of the row above, or the whole number, and some do
/// not: numbers that wander across whole numbers and zero, with ties, and with numbers of any size among them.
#[test]
fn columns_are_written_as_their_numbers_are() {
    let mut random = Random::new(2);
    let decimals = [0, 2, 4, 6, 7, 9];
    let mut numbers = NumberTable::new(&decimals);
    let mut at = [0.3; 6];
    for _ in 0..400 {
        let rows = 1 + (random.bits() % NumberTable::ROWS as u64) as usize;
        let mut columns = vec![Vec::new(); decimals.len()];
        for (column, at) in columns.iter_mut().zip(&mut at) {
            let reach = [0.0, 1e-7, 0.01, 0.7, 300.0][(random.bits() % 5) as usize];
            for _ in 0..rows {
                *at += reach * (2.0 * random.ratio() - 1.0);
                column.push(match random.bits() % 64 {
                    0 => (*at * 256.0).round() / 256.0,
                    1 => at.round(),
                    2 => -*at,
                    3 => *at * 1e6,
                    4 => f64::from_bits(random.bits()),
                    _ => *at,
                });
            }
            *at %= 1000.0;
        }
        numbers.take(&columns, 0..rows);
        for row in 0..rows {
            let (mut together, mut alone) = (Cells::default(), Cells::default());
            numbers.push(&mut together, row, 0..decimals.len());
            for (column, decimals) in columns.iter().zip(decimals) {
                alone.push_fixed(column[row], decimals);
                alone.push_comma();
            }
            let [together, alone] = [together, alone]
                .map(|cells| String::from_utf8(cells.as_bytes().to_vec()).unwrap());
            assert_eq!(together, alone);
        }
    }
}

#[test]
fn edges() {
    assert_eq!(fixed(0.0, 7), "0.0000000");
    assert_eq!(fixed(-0.0, 7), "0.0000000");
    assert_eq!(fixed(-4.9e-8, 7), "0.0000000");
    assert_eq!(fixed(-5.1e-8, 7), "-0.0000001");
    // 1/256 = 0.00390625 is a true tie
    assert_eq!(fixed(0.003_906_25, 7), "0.0039063");
    assert_eq!(fixed(-0.003_906_25, 7), "-0.0039063");
    assert_eq!(fixed(0.999_999_99, 7), "1.0000000");
    assert_eq!(fixed(1e8, 7), "100000000.0000000");
    assert_eq!(fixed(-1e12, 7), "-1000000000000.0000000");
    assert_eq!(fixed(f64::MAX, 2), format!("{:.2}", f64::MAX));
    assert_eq!(fixed(f64::NAN, 7), "");
    assert_eq!(fixed(f64::INFINITY, 7), "");
    assert_eq!(fixed(123_456.789, 0), "123457");
    assert_eq!(fixed(f64::from_bits(1), 7), "0.0000000");
}

#[test]
fn times_and_integers_are_exact() {
    let mut out = Cells::default();
    for micros in [0, 1_834_000, 10_000_000_000_062] {
        out.push_seconds(micros);
    }
    let mut last = Repeating::default();
    for n in [0, 7, 7, 10, 999, 1000, 20_034, u64::MAX, u64::MAX, 0] {
        out.push_integer(n, &mut last);
    }
    assert_eq!(
        std::str::from_utf8(out.as_bytes()).unwrap(),
        "0.000000,1.834000,10000000.000062,\
         0,7,7,10,999,1000,20034,18446744073709551615,18446744073709551615,0,"
    );
}
