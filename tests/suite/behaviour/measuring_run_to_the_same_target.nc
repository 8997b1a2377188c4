; run --set X,Y,Z.kenngr.messachse=1 --input x25.csv: exit 0
; note K-0133 at 6:1
; end X8
(where the first run ends is known in a run only: a check must not refuse the second one)
G100 X50 F500
G100 X50
G01 X8
M30
