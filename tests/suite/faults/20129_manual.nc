; check: exit 1
; error 20129 at 4:6
; error K-0019 at 4:1
G200 G201
M30
