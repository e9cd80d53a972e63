#include "hamjet/maps/symplecticity.hpp"

int main() { return 0; }
