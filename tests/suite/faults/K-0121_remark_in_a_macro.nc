; check: exit 1
; error K-0121 at 5:7
; error K-0121 at 6:1
"END"="X5 ; the end"
F1000 "END" Y3
"END" Y4
M30
