; check: exit 1
; error K-0019 at 4:1
; error 20122 at 4:9
G96 S63 G97
M30
