; run: exit 0
; page 15557280907 tool by its parts (#TOOL DATA)
; warning K-0114 at 5:17
N10 P10=1
N20 #TOOL DATA [P10, 0, ]
N30 #TOOL PREP [P10, 0, 0]
N40 M30
