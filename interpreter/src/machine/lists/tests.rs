use super::*;
use crate::diag::Id;
use crate::machine::table::{Raw, Row};
use proptest::prelude::*;

fn read_text(kind: ListKind, text: &str) -> (List, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    let list = read(kind, "x.lis", text.as_bytes(), &mut diagnostics);
    (list, diagnostics)
}

fn ids(diagnostics: &[Diagnostic]) -> Vec<String> {
    diagnostics.iter().map(|d| d.id.to_string()).collect()
}

fn value(list: &List, key: &str) -> Option<Value> {
    list.entries.iter().find(|e| e.key() == key).map(|e| e.value.clone())
}

/// Conformance: F073.
#[test]
fn a_list_in_the_forms_of_the_manuals() {
    let (list, diagnostics) = read_text(
        ListKind::Axis,
        "# a comment\r\n\r\nkopf.achs_nr                       4\r\n\
         kenngr.achs_typ\tACHSTYP_TRANSLATOR\r\n\
         getriebe[0].kv                     5000      50/s\r\n\
         getriebe[0].dynamik.vb_max         500000    /* um/s\r\n\
         vorsteuer.vorsteuerung             VEL | ACC\r\n\
         vorsteuer.vs_a_faktor              5000      # Ta = 5 ms\r\n\
         filter[0].fg_f0                    2.150000e+001\r\n\
         filter[0].TYPE                     BANDSTOP (a word\r\n",
    );
    assert_eq!(diagnostics, []);
    assert_eq!(list.entries.len(), 8);
    for (key, number) in [
        ("kopf.achs_nr", 4.0),
        ("kenngr.achs_typ", 1.0),
        ("getriebe[0].kv", 5000.0),
        ("getriebe[0].dynamik.vb_max", 500000.0),
        ("vorsteuer.vorsteuerung", 3.0),
        ("vorsteuer.vs_a_faktor", 5000.0),
        ("filter[0].fg_f0", 21.5),
        ("filter[0].type", 4.0),
    ] {
        assert_eq!(value(&list, key), Some(Value::Number(number)), "{key}");
    }
}

/// Conformance: F051, F056.
#[test]
fn the_listing_of_the_feedforward_manual_loads_without_a_message() {
    let (list, diagnostics) = read_text(
        ListKind::Axis,
        "antr.sercos.at[0].ident_nr 37\nantr.sercos.mdt[0].ident_len 4\nantr.sercos.mdt[0].nc_ref S_0_0037\n\
         vorsteuer.vorsteuerung 0x101 #0x001: Activation velocity feedforward\n\
         getriebe[0].load 0.48 #Total motor load 0.48 kg*m**2\n",
    );
    assert_eq!(diagnostics, []);
    assert_eq!(value(&list, "vorsteuer.vorsteuerung"), Some(Value::Number(257.0)));
    assert_eq!(value(&list, "antr.sercos.mdt[0].nc_ref"), Some(Value::Text("S_0_0037".to_owned())));
}

/// Conformance: A011, V053.
#[test]
fn every_rule_has_its_message() {
    let cases: [(&str, &[&str], &str, Option<f64>); 13] = [
        ("vib_guard.ax_dev 0.01", &["1001119"], "vib_guard.ax_dev", None),
        ("getriebe[].kv 3000", &["K-0029"], "getriebe[0].kv", Some(3000.0)),
        ("getriebe[0].kv 3000\ngetriebe[0].kv 4000", &["K-0028"], "getriebe[0].kv", Some(4000.0)),
        ("getriebe[0].kv abc", &["1001138"], "getriebe[0].kv", Some(0.0)),
        ("getriebe[0].kv = 3000", &["1001138"], "getriebe[0].kv", Some(0.0)),
        ("getriebe[0].kv 5 000", &["K-0030"], "getriebe[0].kv", Some(5.0)),
        ("getriebe[0].kv 5 000 # gain", &["K-0030"], "getriebe[0].kv", Some(5.0)),
        ("getriebe[0].kv 5000 1000 is 10/s", &[], "getriebe[0].kv", Some(5000.0)),
        ("kopf.achs_nr 70000", &["1001138"], "kopf.achs_nr", Some(65535.0)),
        ("getriebe[0].kv", &["K-0071"], "getriebe[0].kv", None),
        ("[head]", &["K-0071"], "getriebe[0].kv", None),
        ("filter[3].order 2", &["1001119"], "filter[3].order", None),
        ("END\ngetriebe[0].kv 3000", &["K-0072"], "getriebe[0].kv", None),
    ];
    for (text, expected, key, number) in cases {
        let (list, diagnostics) = read_text(ListKind::Axis, text);
        assert_eq!(ids(&diagnostics), expected, "{text}");
        assert_eq!(value(&list, key), number.map(Value::Number), "{text}");
    }
    let (list, diagnostics) = read_text(
        ListKind::Channel,
        "gruppe[0].achse[0].bezeichnung X table\nfinal_prog_file \"a b \"",
    );
    assert_eq!(ids(&diagnostics), ["K-0030"]);
    assert_eq!(value(&list, "gruppe[0].achse[0].bezeichnung"), Some(Value::Text("X".to_owned())));
    assert_eq!(value(&list, "final_prog_file"), Some(Value::Text("a b".to_owned())));
}

/// A list is the same with every end of line: each entry is read, and none is treated as the comment of the previous
/// one.
#[test]
fn ends_of_lines() {
    let text =
        "kopf.achs_nr 1\ngetriebe[0].kv 10000\n# getriebe[0].kv 1\nlr_param.nothing 1\nEnde\n";
    let facts = |end: &str| {
        let (list, said) = read_text(ListKind::Axis, &text.replace('\n', end));
        (facts(&list), said.iter().map(|d| d.source.as_ref().unwrap().line).collect::<Vec<_>>())
    };
    let expected = facts("\n");
    assert_eq!((expected.0.len(), &*expected.1), (2, &[4][..]));
    for end in ["\r\n", "\r"] {
        assert_eq!(facts(end), expected, "{end:?}");
    }
}

/// Conformance: F081.
#[test]
fn unknown_keys_are_counted_and_named_once() {
    let mut text = String::new();
    for i in 0..20 {
        text = format!("{text}handbetrieb.key{i} 1\nhandbetrieb.key{i} 2\n");
    }
    text.push_str("vorsteuer.jerk_fact_nom 3\n");
    let (_, diagnostics) = read_text(ListKind::Axis, &text);
    assert_eq!(ids(&diagnostics), ["1001119", "1001119"]);
    assert_eq!(diagnostics[0].hint.as_deref(), Some("did you mean `vorsteuer.jerk_fact_num`?"));
    assert!(diagnostics[1].text.starts_with("40 unknown elements"), "{}", diagnostics[1].text);
    assert!(
        diagnostics[1].text.ends_with("and 8 more: handbetrieb (8)"),
        "{}",
        diagnostics[1].text
    );
}

/// An index outside its array is not a misspelt key: the message names the index and the array, without repeating the
/// key.
#[test]
fn an_index_beyond_its_array_is_named() {
    for (line, text) in [
        ("getriebe[4].kv 1", "`getriebe[4].kv` is ignored: index 4 of getriebe is outside 0 to 3"),
        (
            "Filter[3].enable 1",
            "`Filter[3].enable` is ignored: index 3 of filter is outside 0 to 2",
        ),
    ] {
        let (list, said) = read_text(ListKind::Axis, line);
        assert_eq!((ids(&said), list.entries.len()), (vec!["1001119".to_owned()], 0));
        assert_eq!(said[0].text, text);
        assert!(!said[0].hint.as_deref().unwrap_or_default().contains("did you mean"));
    }
    let (list, said) = read_text(ListKind::Axis, "getriebe[3].kv 1");
    assert_eq!((ids(&said).len(), list.entries.len()), (0, 1));
}

/// A list with many errors of one kind has few messages, the last of which counts the others.
#[test]
fn mistakes_of_one_kind_are_counted() {
    let text = "getriebe[0].kv 3000\n".repeat(1001) + &"[head]\n".repeat(21);
    let (_, diagnostics) = read_text(ListKind::Axis, &text);
    let of = |id: &str| diagnostics.iter().filter(|d| d.id.to_string() == id).collect::<Vec<_>>();
    let (twice, no_entry) = (of("K-0028"), of("K-0071"));
    assert_eq!((twice.len(), no_entry.len(), diagnostics.len()), (21, 21, 42));
    assert!(twice[20].text.ends_with("(and 979 more)"), "{}", twice[20].text);
    assert_eq!(twice[20].source.as_ref().map(|at| at.line), Some(22));
    assert!(!no_entry[20].text.contains("more"), "{}", no_entry[20].text);
}

#[test]
fn places_point_at_the_entry() {
    let (list, diagnostics) = read_text(ListKind::Axis, "# ä\n  getriebe[0].kv   abc  # ü\n");
    let at = diagnostics[0].source.clone().unwrap();
    assert_eq!((at.line, at.column, at.offset, at.length), (2, 20, 24, 3));
    let entry = &list.entries[0].at;
    assert_eq!((entry.line, entry.column, entry.offset, entry.length), (2, 3, 7, 20));
    assert_eq!(&*entry.text, "  getriebe[0].kv   abc  # ü");
}

/// A random value of a row and its text in a list.
fn any_value(row: &'static Row) -> BoxedStrategy<Value> {
    match row.raw {
        Raw::Text => "[ -~]{0,20}"
            .prop_filter("no quote, no blank at the end", |s| !s.contains('"') && s.trim_end() == s)
            .prop_map(Value::Text)
            .boxed(),
        Raw::Code => "[A-Z][A-Z0-9=+ ]{0,20}[0-9]".prop_map(Value::Text).boxed(),
        Raw::Word(words) => {
            (0..words.len()).prop_map(move |i| Value::Text(words[i].to_owned())).boxed()
        }
        Raw::Real64 => {
            any::<f64>().prop_filter("finite", |x| x.is_finite()).prop_map(Value::Number).boxed()
        }
        raw => {
            let (low, high) = raw.limits().unwrap();
            (low..=high).prop_map(|x| Value::Number(x.trunc() + 0.0)).boxed()
        }
    }
}

fn any_entry(kind: ListKind) -> impl Strategy<Value = Entry> {
    let rows: Vec<&'static Row> =
        table::rows().filter(|r| r.list == kind && !r.key.is_empty()).collect();
    (0..rows.len(), 0..3_u32, 0..2_u32).prop_flat_map(move |(row, i, j)| {
        let row = rows[row];
        let brackets = row.key.matches('[').count();
        let wanted = [if brackets > 0 { i } else { 0 }, if brackets > 1 { j } else { 0 }];
        let key = Key::parse(&with_indices(row.key, wanted)).unwrap();
        let indices = if key.resolve(kind).is_some() { wanted } else { [0; 2] };
        any_value(row).prop_map(move |value| {
            let (file, text) = ("x".into(), "".into());
            let at = Location { file, line: 1, column: 1, offset: 0, length: 1, block: None, text };
            Entry { row, indices, value, at }
        })
    })
}

fn facts(list: &List) -> Vec<(String, Value)> {
    list.entries.iter().map(|e| (e.key(), e.value.clone())).collect()
}

proptest! {
    #[test]
    fn written_lists_read_back(
        (kind, entries) in prop_oneof![
            Just(ListKind::Axis), Just(ListKind::Channel), Just(ListKind::StartUp), Just(ListKind::Kontur)
        ].prop_flat_map(|kind| (Just(kind), prop::collection::vec(any_entry(kind), 0..30)))
    ) {
        let mut seen = std::collections::BTreeSet::new();
        let entries = entries.into_iter().filter(|e| seen.insert(e.key())).collect();
        let list = List { kind, entries };
        let text = write(&list);
        let (again, diagnostics) = read_text(kind, &text);
        prop_assert_eq!(diagnostics, vec![], "{}", text);
        prop_assert_eq!(facts(&again), facts(&list));
        prop_assert_eq!(write(&again), text);
    }

    #[test]
    fn no_text_stops_the_reader(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let mut diagnostics = Vec::new();
        let list = read(ListKind::Axis, "x.lis", &bytes, &mut diagnostics);
        prop_assert!(list.entries.is_empty() || list.kind == ListKind::Axis);
        let _ = read(ListKind::Axis, "x.lis", &["getriebe[0].kv ".as_bytes(), &bytes].concat(), &mut diagnostics);
        prop_assert!(diagnostics.iter().all(|d| !matches!(d.id, Id::Vendor(0))));
    }

    #[test]
    fn places_lie_in_the_file(text in "([ -~\n\u{e4}]|\r\n?){0,200}") {
        let (_, diagnostics) = read_text(ListKind::Axis, &text);
        for at in diagnostics.iter().filter_map(|d| d.source.as_ref()) {
            let line = text.replace("\r\n", "\n").replace('\r', "\n");
            let line = line.split('\n').nth(at.line as usize - 1).unwrap();
            prop_assert_eq!(line, &*at.text);
            prop_assert!(at.column as usize + at.length as usize <= line.chars().count() + 2);
            prop_assert!(at.offset <= text.len() as u64);
        }
    }
}
