#!/usr/bin/env python3
"""empty for now"""
