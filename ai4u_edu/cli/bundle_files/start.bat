@echo off
rem Starts AI4U Edu on Windows: open it with a double click
cd /d "%~dp0"
for %%v in (VERSIONS) do (
    py -%%v -c "" >nul 2>&1 && (py -%%v start.py %* & goto end)
)
python -c "" >nul 2>&1 && (python start.py %* & goto end)
echo Expected Python (VERSIONS) on this machine, and found none.
pause
exit /b 1
:end
if errorlevel 1 pause
