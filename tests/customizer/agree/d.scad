/* [One] */ a1=1; // 5
a2=2; /* [Two] */
/* [Three] */ a3=3; /* [Four] */
a4=4;
/* [Five
] */
a5=5;
/*
[Six] */
a6=6;
/*[]*/
a7=7;
/* no brackets */
a8=8;
/* [ [x] ] */
a9=9;
/* [a] text [b] c*/
b1=1;
/* [open */
b2=2;
/* close] */
b3=3;
/* ]a[ */
b4=4;
/* [a]b] */
b5=5;
/**[Star]**/
b6=6;
// /* [InLine] */
b7=7;
b8="/* [InString] */";
b9=9;
/* // [Seven] */
c1=1;
/* "[Eight] */
c2=2;
c3="multi
line"; // 5
c4=4; // 6
/* [É ü	x  ] */
c5=5;
//d1
c6=
6; // 5
//d2
c7
=7; // 5
c8=8; /* [Nine] */ // 7
c9=9;
/* [A"b\c] */
d1=1;
/***/
d2=2;
/**/
d3=3;
/*/ [Odd] */
d4=4;
/* [Hidden] */
d5=5;
/* [Hidden] [x] */
d6=6;
/* [Global] */
d7=7;
/* [hidden] */
d8=8;
/*[Parameters]*/
d9=9;
