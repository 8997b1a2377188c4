; run: exit 0
; page 15556863115 coordinates by parameters
; end X5
N10 P1=10 P2=1
N20 G01 X P1*SIN [P2*30] F1000
N30 M30
