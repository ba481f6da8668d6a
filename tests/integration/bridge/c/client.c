/* The client in a file of its own, as a project has it. */
#define SCENE2HAP_CLIENT_IMPLEMENTATION
#include "scene2hap_client.h"
