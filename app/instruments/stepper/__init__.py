"""The loop stepper: object order and image order, line by line."""
