"""What bench/rivals.py is made of; each module opens with what it is for."""
