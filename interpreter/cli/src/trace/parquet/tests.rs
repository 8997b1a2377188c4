use super::*;
use crate::trace::batch::Numbers;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::record::RowAccessor;
use kontur_interpreter::job::{AxisFacts, FileNames};
use kontur_interpreter::record::columns;
use kontur_interpreter::record::{AxisRecord, CycleRecord, PathRecord, SpeedLimit};

/// Rows written before an error stay at the location stated in the error.
#[test]
fn parts_outlive_an_error() {
    let facts = Facts { cycle_us: 1000, ..Facts::default() };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    let columns = columns::select("time", &facts).unwrap();
    let target = Target::create(&path).unwrap();
    let mut row = Batch::default();
    row.push(&Numbers::of(&columns), &CycleRecord::default());
    let mut writer = ParquetWriter::new(&path, target, &columns, &facts).unwrap();
    for _ in 0..ROWS_PER_GROUP {
        writer.write(&row).unwrap();
    }
    writer.write_parts().unwrap();
    let part = writer.parts[0].clone();
    // a file cannot be created in place of a folder
    std::fs::create_dir(part.with_file_name(".000002.part")).unwrap();
    for _ in 0..ROWS_PER_GROUP {
        writer.write(&row).unwrap();
    }
    let error = writer.write_parts().unwrap_err();
    drop(writer);
    let said = error.to_string();
    assert!(said.contains(&part.parent().unwrap().display().to_string()), "{said}");
    let reader = SerializedFileReader::new(File::open(&part).unwrap()).unwrap();
    let rows = reader.metadata().file_metadata().num_rows();
    assert_eq!(usize::try_from(rows), Ok(ROWS_PER_GROUP));
}

/// The trace cannot be put together: the rows that no part has yet become one.
#[test]
#[cfg(target_os = "linux")]
fn rows_that_wait_outlive_an_error_too() {
    let facts = Facts { cycle_us: 1000, ..Facts::default() };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    let columns = columns::select("time", &facts).unwrap();
    let mut row = Batch::default();
    row.push(&Numbers::of(&columns), &CycleRecord::default());
    let full = Target::create("/dev/full".as_ref()).unwrap();
    let mut writer = ParquetWriter::new(&path, full, &columns, &facts).unwrap();
    for _ in 0..ROWS_PER_GROUP + 3 {
        writer.write(&row).unwrap();
    }
    writer.write_parts().unwrap();
    let first = writer.parts[0].clone();
    let error = writer.finish(&facts, &Totals::default()).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::StorageFull);
    for (part, rows) in
        [(first.clone(), ROWS_PER_GROUP), (first.with_file_name("000002.parquet"), 3)]
    {
        let reader = SerializedFileReader::new(File::open(part).unwrap()).unwrap();
        assert_eq!(usize::try_from(reader.metadata().file_metadata().num_rows()), Ok(rows));
    }
}

/// Whether the groups are written once, or come from parts.
#[test]
fn reads_back_bit_by_bit() {
    reads_back(false);
    reads_back(true);
}

fn reads_back(from_parts: bool) {
    let axis = AxisFacts { name: "X".to_owned(), ..AxisFacts::default() };
    let facts = Facts {
        program: "part.nc".to_owned(),
        machine: "xyz".to_owned(),
        cycle_us: 500,
        axes: vec![axis],
        files: FileNames::new(vec!["a.nc".to_owned(), "b.nc".to_owned()], true),
    };
    let position = |k: u64| 100.0 * libm::sin(k as f64 * 1e-4) / 3.0;
    // constant in the first group, and at the beginning of the second one
    let set = |k: u64| if k < ROWS_PER_GROUP as u64 + 999 { -0.0 } else { position(k) };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    let columns = columns::select("v_limit,ipo,set", &facts).unwrap();
    let target = Target::create(&path).unwrap();
    let mut writer = ParquetWriter::new(&path, target, &columns, &facts).unwrap();
    let rows = 2 * ROWS_PER_GROUP as u64 + 5;
    let record = |k: u64| CycleRecord {
        k,
        file: u32::from(k > 10),
        line: 7 + (k / 4) as u32,
        block: k.is_multiple_of(3).then_some(k),
        path: PathRecord { limit: SpeedLimit::AxDev, ..PathRecord::default() },
        axes: vec![AxisRecord { ipo: position(k), set: set(k), ..AxisRecord::default() }],
        ..CycleRecord::default()
    };
    // batches that do not end at group boundaries
    for first in (0..rows).step_by(700) {
        let mut batch = Batch::default();
        (first..rows.min(first + 700)).for_each(|k| batch.push(&Numbers::of(&columns), &record(k)));
        writer.write(&batch).unwrap();
        if from_parts {
            writer.write_parts().unwrap();
        }
    }
    assert_eq!(writer.parts.len(), if from_parts { 2 } else { 0 });
    let totals = Totals { filter_delay_cycles: vec![12.5], ..Totals::default() };
    writer.finish(&facts, &totals).unwrap();

    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    let size = |group: usize| reader.metadata().row_group(group).column(6).compressed_size();
    assert!(size(0) < 100 && size(1) > 10_000, "a constant is stored once");
    let meta = reader.metadata().file_metadata().key_value_metadata().unwrap().clone();
    let value = |key: &str| meta.iter().find(|m| m.key == key).unwrap().value.clone().unwrap();
    assert_eq!(value("kontur.cycle_us"), "500");
    assert_eq!(value("kontur.filter_delay_cycles.X"), "12.5");
    let mut k = 0_u64;
    for row in reader.get_row_iter(None).unwrap() {
        let row = row.unwrap();
        assert_eq!(row.get_double(0).unwrap().to_bits(), (k as f64 * 500.0 / 1e6).to_bits());
        assert_eq!(row.get_long(1).unwrap(), 7 + (k / 4).cast_signed());
        assert_eq!(row.get_long(2).ok(), k.is_multiple_of(3).then(|| k.cast_signed()));
        assert_eq!(row.get_string(3).unwrap(), if k > 10 { "b.nc" } else { "a.nc" });
        assert_eq!(row.get_string(4).unwrap(), "ax_dev");
        assert_eq!(row.get_double(5).unwrap().to_bits(), position(k).to_bits());
        assert_eq!(row.get_double(6).unwrap().to_bits(), set(k).to_bits());
        k += 1;
    }
    assert_eq!(k, rows);
}
