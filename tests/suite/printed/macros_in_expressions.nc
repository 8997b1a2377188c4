; run: exit 0
; page 208413579 macros in expressions, right
; end X60
N10 "STRING1" = "0.5"
N20 "STRING2" = "5 * 12"
N30 "STRING3" = "SIN[89.5 + \"STRING1\"]"
N40 G01 X[-2 * "STRING1" + "STRING2" + "STRING3"] F3000
N50 M30
