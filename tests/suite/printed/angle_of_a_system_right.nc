; run: exit 0
; page 252190603 diagnosis 20676, right
N10 #CS ON [10,20,0,45,0,90]
N20 #CS OFF
N30 M30
