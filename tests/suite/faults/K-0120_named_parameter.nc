; check: exit 1
; error K-0120 at 3:1
#<depth> = 5
G1 X#<depth> F100
#100 = 3
M30
