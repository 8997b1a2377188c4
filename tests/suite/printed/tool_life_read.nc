; run: exit 0
; page 208592267 tool life of a tool (#TOOL LIFE READ, REMOVE)
; warning K-0100 at 5:1
; warning K-0100 at 6:1
#TOOL LIFE READ [V.G.T_AKT]
#TOOL LIFE REMOVE
M30
