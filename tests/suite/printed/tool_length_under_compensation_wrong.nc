; check: exit 1
; page 252181899 diagnosis 20671, wrong
; warning K-0114 at 5:5
; error 20671 at 6:5
N10 G41
N20 #TLC ON [25]
N100 #TLC OFF
N110 G40
N1000 M30
