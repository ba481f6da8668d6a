"""Model backends: OpenAI, local servers, recorded answers and Python functions, and the HTTP that they share."""
