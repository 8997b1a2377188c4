; check: exit 1
; error K-0121 at 7:1
; error K-0121 at 8:4
N10 "STRING1" = "COS["
N20 "STRING2" = "90]"
N30 "STRING3" = "X\"STRING1\"\"STRING2\""
"STRING3"
G1 "STRING1" 90] F100
M30
