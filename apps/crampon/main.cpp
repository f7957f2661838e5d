#include <cstdio>

int main() { std::puts("crampon 0.1.0"); }
