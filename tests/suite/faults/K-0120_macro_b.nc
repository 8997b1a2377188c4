; check: exit 1
; error K-0120 at 4:1
G90
#100=5
WHILE [#100 LT 10] DO1
END1
M30
