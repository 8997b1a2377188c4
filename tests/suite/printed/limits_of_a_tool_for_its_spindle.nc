; run -m ../../tests/suite/machines/limited_tool: exit 0
; page 287608459 limits of a tool for its spindle (P-TOOL-00012 to 00015), adopted while it turns as on 208242699
; end X150 Y200
; warning K-0131 at 7:6
; warning K-0131 at 11:7
N10 T1 D1
N20 S[M3 REV2002]
N25 G01 X100 Y100 F10000
N30 T99 D99
N35 X200 Y150
N40 S[GET_DYNAMIC_DATA]
N45 X150 Y200
N50 M5
N60 M30
