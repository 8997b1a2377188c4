; run: exit 0
; page 1025583755 tool life set (#TOOL LIFE DEF)
; warning K-0100 at 4:1
#TOOL LIFE DEF [DIST=5 TIME=2]
M30
