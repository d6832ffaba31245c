"""The pipeline: a job and its drawing become planned contours, and these a checked tape."""
