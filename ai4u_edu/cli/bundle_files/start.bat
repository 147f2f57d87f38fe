@echo off
rem Starts AI4U Edu on Windows: open it with a double click
cd /d "%~dp0"
for %%v in (VERSIONS) do (
    py -%%v --version >nul 2>&1 && (py -%%v start.py %* & goto end)
)
python start.py %*
:end
if errorlevel 1 pause
