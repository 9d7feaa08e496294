//! `ectwin import`: a capture becomes a scenario, which `ectwin replay` accepts.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[path = "replay/bench.rs"]
#[expect(dead_code, reason = "each test uses a part of the bench")]
mod bench;

use bench::Bench;

const LIVE: &str = r#"title = "three units go to OP, and the serial number of the second is read"
units = ["unit.toml", "unit.toml", "unit.toml"]
steps = [
  { master = "take all units to OP" },
  { when = "all units are in OP", master = "read SDO 1018:04 of unit 2" },
  { after = "50ms", expect = "the last SDO gave 4D 00 00 00" },
]
"#;

/// A bench with `captures/live.pcapng`.
fn with_capture(name: &str) -> Bench {
    let bench = Bench::new(name);
    bench.put("units/unit.toml", "model = \"nx-ect101\"\nserial = 77\n");
    bench.put("units/other.toml", "model = \"nx-ect101\"\nserial = 78\n");
    bench.put("units/live.toml", LIVE);
    bench.put("captures/readme.md", "");
    let ended = bench.ectwin(&["replay", "units/live.toml", "--pcap", "captures/live.pcapng"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
    bench
}

#[test]
fn the_same_units_answer_as_captured_and_another_one_does_not() {
    let bench = with_capture("import");
    let unit = |name: &'static str| ["--unit", name];
    let same = [unit("units/unit.toml"); 3].concat();
    let other = [unit("units/unit.toml"), unit("units/other.toml"), unit("units/unit.toml")].concat();
    for (units, output, code) in [(same, "units/same.toml", 0), (other, "units/other-line.toml", 1)] {
        let ended =
            bench.ectwin(&[&["import", "captures/live.pcapng", "-o", output], units.as_slice()].concat());
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{}", ended.stdout);
        assert!(ended.stdout.starts_with(&format!("{output}: ")), "{}", ended.stdout);
        let ended = bench.ectwin(&["replay", output]);
        assert_eq!(ended.code, Some(code), "{}{}", ended.stdout, ended.stderr);
        assert_eq!(ended.stdout.contains("`every answer is as captured`"), code == 1, "{}", ended.stdout);
    }
    let written = bench.text("units/same.toml");
    assert!(written.contains("capture = \"../captures/live.pcapng\""), "{written}");
    assert!(written.contains("units = [\"unit.toml\", \"unit.toml\", \"unit.toml\"]"), "{written}");
}

#[test]
fn without_unit_files_there_are_as_many_units_as_have_answered() {
    let bench = with_capture("import-default");
    assert_eq!(bench.ectwin(&["import", "captures/live.pcapng", "-o", "again.toml"]).code, Some(0));
    let written = bench.text("again.toml");
    assert_eq!(written.matches("{ model = \"nx-ect101\" }").count(), 3, "{written}");

    let told =
        bench.ectwin(&["import", "captures/live.pcapng", "-o", "one.toml", "--unit", "units/unit.toml"]);
    assert_eq!(told.code, Some(0));
    assert!(
        told.stderr.contains("the capture contains a line of 3 units, but 1 are given"),
        "{}",
        told.stderr
    );
}

#[test]
fn what_is_no_capture_is_refused_with_a_way_out() {
    let bench = with_capture("import-refused");
    bench.put("text.pcapng", "no capture");
    bench.put("old.toml", "");
    // An empty section.
    let mut empty = vec![0x0A, 0x0D, 0x0D, 0x0A, 28, 0, 0, 0, 0x4D, 0x3C, 0x2B, 0x1A, 1, 0, 0, 0];
    empty.extend([0xFF; 8]);
    empty.extend([28, 0, 0, 0]);
    std::fs::write(bench.folder.join("empty.pcapng"), empty).unwrap();
    for (arguments, fragment) in [
        (&["gone.pcapng", "-o", "x.toml"][..], "cannot read gone.pcapng: No such file"),
        (&["text.pcapng", "-o", "x.toml"], "neither a pcapng nor a pcap capture"),
        (&["old.toml", "-o", "x.toml"], "this is a TOML file"),
        (&["empty.pcapng", "-o", "x.toml"], "it contains no EtherCAT frame of a master"),
        (&["captures/live.pcapng", "-o", "old.toml"], "old.toml is there already"),
        (&["captures/live.pcapng", "-o", "no/such/x.toml"], "cannot write no/such"),
        (&["captures/live.pcapng", "-o", "x.toml", "--unit", "gone.toml"], "cannot read gone.toml"),
        (&["captures/live.pcapng"], "--output"),
    ] {
        let ended = bench.ectwin(&[&["import"], arguments].concat());
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
    }
    assert!(!bench.folder.join("x.toml").exists());
}

/// The frames of a capture as `tcpdump -w` writes them.
fn as_pcap(pcapng: &[u8]) -> Vec<u8> {
    let (nanoseconds, version, ethernet) = (0xA1B2_3C4D, 0x0004_0002, 1);
    let mut pcap = [nanoseconds, version, 0, 0, 65_535, ethernet].map(u32::to_le_bytes).concat();
    for packet in capture::read_packets(pcapng).unwrap() {
        let [seconds, rest] = [packet.at_nanos / 1_000_000_000, packet.at_nanos % 1_000_000_000];
        let length = packet.frame.len() as u32;
        pcap.extend([seconds as u32, rest as u32, length, length].map(u32::to_le_bytes).concat());
        pcap.extend(packet.frame);
    }
    pcap
}

#[test]
fn a_pcap_file_is_imported_like_the_pcapng_file_of_the_same_frames() {
    let bench = with_capture("import-pcap");
    let pcapng = std::fs::read(bench.folder.join("captures/live.pcapng")).unwrap();
    std::fs::write(bench.folder.join("captures/live.pcap"), as_pcap(&pcapng)).unwrap();
    for capture in ["captures/live.pcapng", "captures/live.pcap"] {
        let units = ["--unit", "units/unit.toml"].repeat(3);
        let output = capture.replace("captures/", "units/") + ".toml";
        let ended = bench.ectwin(&[&["import", capture, "-o", &output], units.as_slice()].concat());
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{}", ended.stdout);
        let ended = bench.ectwin(&["replay", &output]);
        assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
    }
}

#[test]
fn differences_are_counted_by_kind_in_text_and_json() {
    let bench = with_capture("import-kinds");
    let two = ["--unit", "units/unit.toml", "--unit", "units/unit.toml", "-o", "units/two.toml"];
    assert_eq!(bench.ectwin(&[&["import", "captures/live.pcapng"], &two[..]].concat()).code, Some(0));
    // The third unit does not exist, and two frames are lost in addition.
    let lose = "steps = [\n  { line = \"lose the next 2 frames\" },";
    bench.put("units/two.toml", &bench.text("units/two.toml").replace("steps = [", lose));
    let ended = bench.ectwin(&["replay", "units/two.toml", "--json", "out.jsonl"]);
    assert_eq!(ended.code, Some(1), "{}{}", ended.stdout, ended.stderr);

    let case = bench.json_lines("out.jsonl").remove(0);
    let differences = case["differences"].as_array().unwrap();
    let counts: Vec<u64> = differences.iter().map(|kind| kind["count"].as_u64().unwrap()).collect();
    assert!(counts.is_sorted_by(|one, next| one >= next), "the most frequent first: {counts:?}");
    let seen = case["failure"]["seen"].as_str().unwrap();
    assert!(seen.starts_with(&format!("{} answers differ; ", counts.iter().sum::<u64>())), "{seen}");
    let find = |kind: &str, command: Option<&str>, place: Option<&str>| {
        let is_it = |row: &&serde_json::Value| {
            row["kind"] == kind && row["command"].as_str() == command && row["place"].as_str() == place
        };
        differences.iter().find(is_it).unwrap_or_else(|| panic!("no {kind} of {command:?} {place:?}: {case}"))
    };
    assert_eq!(find("missing_answer", None, None)["count"], 2);
    find("working_counter", Some("APWR"), Some("AL control"));
    find("working_counter", Some("APRD"), Some("AL status"));
    for row in differences {
        let told =
            format!("        differs {} × {}", row["count"], row["kind"].as_str().unwrap().replace('_', " "));
        assert!(ended.stdout.contains(&told), "`{told}` is not in:\n{}", ended.stdout);
        assert!(ended.stdout.contains(row["first"].as_str().unwrap()), "{}", ended.stdout);
    }
    let merged = bench.ectwin(&["merge", "out.jsonl"]);
    assert_eq!(merged.code, Some(1), "{}", merged.stderr);
}

/// A block of a pcapng file.
fn block(block_type: u32, body: &[u8]) -> Vec<u8> {
    let length = (body.len() as u32 + 12).to_le_bytes();
    [&block_type.to_le_bytes()[..], &length, body, &length].concat()
}

/// A frame with APRD of two bytes at this position: from the master, or as returned.
fn by_position(position: u16, answered: bool) -> Vec<u8> {
    let mut frame = vec![0; 60];
    frame[..6].fill(0xFF);
    frame[6] = if answered { 0x02 } else { 0 };
    frame[12..16].copy_from_slice(&[0x88, 0xA4, 0x0E, 0x10]);
    frame[16..18].copy_from_slice(&[1, 7]);
    frame[18..20].copy_from_slice(&position.to_le_bytes());
    frame[20..24].copy_from_slice(&[0x30, 0x01, 2, 0]);
    frame
}

#[test]
fn a_capture_of_more_units_than_there_can_be_makes_no_scenario_of_them() {
    let bench = Bench::new("import-units");
    let packet = |at: u8, frame: &[u8]| {
        let head = [[0; 4], [0; 4], [at, 0, 0, 0], [60, 0, 0, 0], [60, 0, 0, 0]].concat();
        block(6, &[&head[..], frame].concat())
    };
    for (units, code) in [(1_000, 0), (1_001, 2), (u16::MAX, 2)] {
        let section =
            block(0x0A0D_0D0A, &[[0x4D, 0x3C, 0x2B, 0x1A], [1, 0, 0, 0], [0xFF; 4], [0xFF; 4]].concat());
        let ethernet = block(1, &[1, 0, 0, 0, 0, 0, 0, 0]);
        let (sent, back) = (packet(1, &by_position(0, false)), packet(2, &by_position(units, true)));
        std::fs::write(bench.folder.join("line.pcapng"), [section, ethernet, sent, back].concat()).unwrap();
        let ended = bench.ectwin(&["import", "line.pcapng", "-o", &format!("of-{units}.toml")]);
        assert_eq!(ended.code, Some(code), "{units}: {}{}", ended.stdout, ended.stderr);
        let says = ended.stderr.contains(&format!("contains a line of {units} units; at most 1000"));
        assert_eq!(says, code == 2, "{}", ended.stderr);
    }
}

#[test]
fn a_path_that_is_not_utf_8_is_refused_and_one_of_any_characters_is_written() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let bench = with_capture("import-names");
    let odd = "odd\u{7F}\u{1}\"name.pcapng";
    std::fs::copy(bench.folder.join("captures/live.pcapng"), bench.folder.join(odd)).unwrap();
    let units = [["--unit", "units/unit.toml"]; 3].concat();
    assert_eq!(bench.ectwin(&[&["import", odd, "-o", "odd.toml"], units.as_slice()].concat()).code, Some(0));
    let ended = bench.ectwin(&["replay", "odd.toml"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);

    let latin = bench.folder.join(OsStr::from_bytes(b"z\xE4hler"));
    std::fs::create_dir(&latin).unwrap();
    std::fs::rename(bench.folder.join(odd), latin.join("live.pcapng")).unwrap();
    std::os::unix::fs::symlink(&latin, bench.folder.join("link")).unwrap();
    let ended = bench.ectwin(&["import", "link/live.pcapng", "-o", "latin.toml"]);
    assert_eq!(ended.code, Some(2), "{}", ended.stdout);
    assert!(ended.stderr.contains("is not UTF-8, so no scenario can name it"), "{}", ended.stderr);
    assert!(!bench.folder.join("latin.toml").exists());
}
