; run: exit 0
; end X7 Y8 Z0
(of blocks that come after the end of the program)
G01 F1000
L SEQUENCE [N7 N8]
M30
N7 X7
N8 Y8
