"""The job: what is wanted of a drawing, of its layers and of its contours."""
