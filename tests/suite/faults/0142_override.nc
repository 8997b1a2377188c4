; run --input override150.csv: exit 0
; warning K-0142 at -
G01 X1 F1000
M30
