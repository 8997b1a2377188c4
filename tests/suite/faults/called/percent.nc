X1 F1000
% a remark
M17
