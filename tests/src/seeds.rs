//! Inputs for the targets of the fuzzer: what the repository has of each kind, and mutations of it.

use kontur_kit::Random;
use std::path::Path;

/// Separates the parts of an input that consists of several files.
pub const BETWEEN: &[u8] = b"\n====\n";

/// Programs that combine rare functions.
const RARE: [&str; 9] = [
    include_str!("../../interpreter/tests/data/squares.nc"),
    "V.G.WZ[1].R=2\nD1 G41 G01 X10 F6000\nX30 Y5\nG03 X30 Y25 J10\nX10\nG40 X0 Y0\nM30\n",
    "#CONTOUR MODE [DIST PRE_DIST=1 POST_DIST=2]\nG261 F6000\nX10\nY10\nG02 X20 Y0 I5\nG260\nM30\n",
    "#HSC ON [BSPLINE PATH_DEV=0.05]\nG01 F6000\nX1 Y0.1\nX2 Y0.3\nX3 Y0\nX4 Y0.2\n#HSC OFF\nM30\n",
    "#SLOPE [TYPE=HSC NO_OPT=0]\n#VIB GUARD ON [MODE=3 FREQ=40 AX_DEV=0.01]\nG01 X10 F6000\nY10\nX0 Y0\nM30\n",
    "G93 F0.5 X10\nG95 S1000 M3 F0.1 X0\nG194 F50 Y10\nG94 F3000 Y0 E500\nM30\n",
    "S[M3 REV1000]\nG04 S5\nS[POS=45 M19]\nX5 F2000 G135 G136 X80\nG137\nM30\n",
    "#CS ON [1,2,3,0,0,30]\nG01 X5 F2000\n#ROTATION ON [ANGLE=20]\nG02 X10 I2.5\n#CS OFF ALL\nM30\n",
    "X5 F2000\nG301 I1\nY5\nG302 I0.5 X0\nG91 G60 X-1 Z2\nG18 G03 Z-2 K-1\nM30\n",
];

/// Numbers that are special somewhere.
const NUMBERS: &str = "0 1 -1 0.0001 1e9 2147483648 -0 0.5 90 100 360 1000000 4294967296 0.00000000000001 \
                       99999999999999999999 . 65536 3 10";

/// Seed inputs for a target: what the repository has of this kind.
pub fn corpus(target: &str) -> Vec<Vec<u8>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let programs = || {
        let mut found = Vec::new();
        for folder in ["programs", "programs/lessons", "programs/fail", "tests/suite/faults"] {
            found.extend(files(&root.join(folder), "nc").into_iter().filter(|f| f.len() < 20_000));
        }
        found.extend(RARE.map(|text| text.as_bytes().to_vec()));
        found
    };
    match target {
        "check" | "run" | "report" => programs(),
        "lists" => {
            let machine = |name: &str| {
                let read = |list: &str| {
                    let path = root.join("programs/machines").join(name).join(list);
                    std::fs::read(path).unwrap_or_default()
                };
                ["hochlauf.lis", "channel.lis", "x.lis", "kontur.lis"].map(read).join(BETWEEN)
            };
            ["xyz", "rack_and_pinion", "vendor_defaults", "gantry", "xyz_hsc"].map(machine).to_vec()
        }
        "inputs" => files(&root.join("programs"), "csv"),
        "recording" => {
            let wave = |t: f64| libm::exp(-3.0 * t) * libm::sin(200.0 * t);
            let rows = (0..200).map(|k| f64::from(k) * 1e-3).map(|t| format!("{t},{}\n", wave(t)));
            vec![("t_s,a\n".to_owned() + &rows.collect::<String>()).into_bytes()]
        }
        "diff" => {
            let trace = b"t_s,line,block,v_limit,X_set_mm\n0,1,,feed,0.5\n0.001,1,10,stop,inf\n";
            vec![[&trace[..], &trace[..]].join(BETWEEN), [&trace[..], b"t_s\n"].join(BETWEEN)]
        }
        _ => [
            "run\na.nc\n-o\na.csv\n--set\nX.getriebe[0].kv=5000\n--start\nX10,Y5\n--skip\n1,3",
            "sweep\na.nc\n--vary\nX.getriebe[0].kv=1000..5000:500\n--amplitude\nX_lag_mm@50..56@1..2",
            "tune\n--freq\n40,50\n--damping\n0.05\n--max-residual\n3",
            "response\n--filter\nLOWPASS,BESSEL,4,50\n--freq\n1..100",
            "report\na.nc\n--signals\nipo\n--spectrum\n2..80\n--window\n0.7..1.9",
        ]
        .map(|words| words.as_bytes().to_vec())
        .to_vec(),
    }
}

/// Files of a folder with an extension, sorted by name.
fn files(folder: &Path, extension: &str) -> Vec<Vec<u8>> {
    let entries = std::fs::read_dir(folder).expect("a folder of the repository").flatten();
    let mut paths: Vec<_> = entries.map(|e| e.path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == extension));
    paths.sort();
    paths.iter().map(|p| std::fs::read(p).expect("a file of the repository")).collect()
}

/// Words known to the readers: of the grammar, of the parameter tables, of the programs of the suite.
pub fn dictionary() -> Vec<String> {
    let mut words = std::collections::BTreeSet::new();
    let grammar = include_str!("../../interpreter/src/nc.pest");
    // every second piece between quotes is a literal
    for line in grammar.lines().filter(|line| !line.starts_with("//")) {
        words.extend(line.split('"').skip(1).step_by(2).map(str::to_owned));
    }
    words.extend(kontur_interpreter::machine::table::rows().map(|row| row.key.to_owned()));
    for program in corpus("check") {
        let text = String::from_utf8_lossy(&program);
        let code = text.lines().filter_map(|line| line.split([';', '(']).next());
        for word in code
            .flat_map(|line| line.split(|c: char| !(c.is_ascii_alphabetic() || "#$_".contains(c))))
        {
            words.insert(word.to_owned());
        }
    }
    words.retain(|w| {
        w.len() > 1 && w.bytes().all(|b| (b' '..=b'~').contains(&b) && !b"\\\"".contains(&b))
    });
    words.into_iter().collect()
}

/// An input with a few mutations: characters, lines, numbers, words of the dictionary, or pieces of another input.
pub fn mutated(input: &[u8], other: &[u8], words: &[String], random: &mut Random) -> Vec<u8> {
    let mut out = input.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(out.len() + 1);
        let end = (at + 1 + random.below(8)).min(out.len());
        match random.below(9) {
            0 => drop(out.drain(at.min(end)..end)),
            1 => out.insert(at, random.below(256) as u8),
            2 => {
                let word = words[random.below(words.len())].as_bytes();
                drop(out.splice(at..at, word.iter().copied()));
            }
            3 => {
                let piece = out[at.min(end)..end].to_vec();
                let many = piece.repeat(1 + random.below(40));
                drop(out.splice(at..at, many));
            }
            4 => {
                let from = random.below(other.len() + 1);
                let to = (from + random.below(60)).min(other.len());
                drop(out.splice(at..at, other[from.min(to)..to].iter().copied()));
            }
            5 => {
                let signs = b"[]()\"-+=;,.#$%@/\\ \n0123456789";
                let sign = signs[random.below(signs.len())];
                drop(out.splice(at..end.max(at), [sign]));
            }
            6..8 => {
                let digit = |i: &usize| out[*i].is_ascii_digit() || out[*i] == b'.';
                let Some(first) = (at..out.len()).find(digit) else { continue };
                let last = (first..out.len()).find(|i| !digit(i)).unwrap_or(out.len());
                let numbers: Vec<&str> = NUMBERS.split_whitespace().collect();
                drop(out.splice(first..last, random.pick(&numbers).bytes()));
            }
            _ => out.truncate(at.max(out.len() / 2)),
        }
    }
    out.truncate(64 * 1024);
    out
}
