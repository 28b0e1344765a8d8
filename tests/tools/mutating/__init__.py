"""Changes lines of the product and counts how many changes the tests see."""
