//  lead	x // // tail //  
a1=1;
	//tabbed
a2=1;
//desc with "quotes" \ back
a3=1;
//
a4=1;
///three
a5=1;
// a
 a6=1; // 3
//x
// y
a7=1;
a8=1; //own line
a9=1;
/*
// inblock
*/ b1=1;
s="
// instring
"; // 4
b2=1;
b3=1; /* c */ b4=2; // 7
b5="x" ; // y "
