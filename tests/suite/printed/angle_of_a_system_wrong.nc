; check: exit 1
; page 252190603 diagnosis 20676, wrong
; error 20676 at 4:26
N10 #CS ON [10,20,0,45,0,450]
N20 M30
