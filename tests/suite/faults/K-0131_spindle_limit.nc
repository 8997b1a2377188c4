; run: exit 0
; warning K-0131 at 3:4
M3 S15000
M5
M30
